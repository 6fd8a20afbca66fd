#include "bench/plan/new_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "assembly/scene.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/json.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "support/atomic_file.hpp"

namespace airybench {
namespace {

// An object with a line for each key.
std::string in_lines(const Json& object) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : object.items())
    lines.push_back(fmt::format("    {}: {}", json_text(key), json_text(value)));
  return fmt::format("{{\n{}\n  }}", fmt::join(lines, ",\n"));
}

std::string length_unit_of(const Options& options) {
  const std::string setting = std::string(length_unit_setting.option) + "=";
  for (const std::string& given : options.model_settings)
    if (given.starts_with(setting)) return given.substr(setting.size());
  return "mm";
}

Json values_to_fill_in(const std::string& label) {
  switch (parse_boundary_label(label)->role) {
    case BoundaryRole::displacement:
      return {{"displacement_mm", {0, 0}}};
    case BoundaryRole::force:
      return {{"traction_MPa", {0, 0}}};
    case BoundaryRole::contact:
      break;
  }
  return {{"friction", Scene().friction}, {"clearance_mm", 0}};
}

}  // namespace

std::string new_scene_text(const std::filesystem::path& model, const Options& options) {
  const Json shown = parse_json(curves_of_model(model, options));
  const Material material;
  const Json of_material = {{"young_MPa", material.young_MPa}, {"poisson", material.poisson}};
  Json roles = Json::object(), boundary = Json::object(), materials = Json::object();
  for (const Json& curve : shown["curves"]) {
    const std::string role = curve["role"];
    const std::vector<std::string> names = curve["names"];
    if (std::ranges::find(names, role) == names.end())
      roles[names.empty() ? std::to_string(curve["number"].get<int>()) : names.front()] = role;
    boundary[role] = values_to_fill_in(role);
  }
  for (const Json& body : shown["bodies"]) materials[body.get<std::string>()] = of_material;
  std::vector<std::string> lines = {
      fmt::format("\"length_unit\": {}", json_text(length_unit_of(options))),
      "\"plane\": \"strain\"",
      fmt::format("\"materials\": {}", in_lines(materials)),
      "\"displacement_mm\": [0, 0]",
      "\"body_force_N_per_mm3\": [0, 0]",
      "\"crown_radius_mm\": null",
      fmt::format("\"boundary\": {}", in_lines(boundary))};
  if (!roles.empty())
    lines.insert(lines.begin() + 1, fmt::format("\"roles\": {}", in_lines(roles)));
  return fmt::format("{{\n  {}\n}}\n", fmt::join(lines, ",\n  "));
}

std::string write_new_scene(const std::filesystem::path& model, const Options& options) {
  const std::string name = model_name(model) + ".json";
  const auto refuse_if_there = [&] {
    if (std::error_code error; std::filesystem::exists(name, error))
      throw FileError(name + ": is there already (allowed: a name that is free)");
  };
  refuse_if_there();
  const std::string text = new_scene_text(model, options);
  refuse_if_there();
  write_file_atomically(name, text);
  return name;
}

}  // namespace airybench
