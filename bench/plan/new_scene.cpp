#include "bench/plan/new_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/scene.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/json.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "support/atomic_file.hpp"
#include "support/sign_of_life.hpp"

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

// "sole" of "Contact_sole".
std::string part_of(const std::string& name, const std::string& role) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  std::string part = name;
  const auto at = std::search(part.begin(), part.end(), role.begin(), role.end(), same);
  part.erase(at, at + std::min(part.end() - at, std::ssize(role)));
  const auto is_part = [](char c) {
    return c < 0 || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  part.erase(part.begin(), std::ranges::find_if(part, is_part));
  while (!part.empty() && !is_part(part.back())) part.pop_back();
  return part;
}

// A curve that is given no role is addressed by its name, with the role that this may mean.
std::string label_of(const Json& curve) {
  const std::string role = curve["role"], perhaps = curve["perhaps"];
  const std::vector<std::string> names = curve["names"];
  const bool is_given = role != "force" || std::ranges::find(names, role) != names.end();
  if (is_given || names.empty()) return role;
  if (perhaps.empty()) return fmt::format("{}:{}", role, names.front());
  const std::string part = part_of(names.front(), perhaps);
  return part.empty() ? perhaps : fmt::format("{}:{}", perhaps, part);
}

// Without the rounding of a mesher.
Json rounded(const Eigen::Vector2d& mm) {
  const auto to_pm = [](double x) { return std::round(x * 1e9) / 1e9 + 0.; };
  return {to_pm(mm.x()), to_pm(mm.y())};
}

using Walks = std::vector<std::vector<Eigen::Vector2d>>;

// What a contact face just touches, drawn with the body on its left: a flat wall against its mean
// outward normal; a pin in a hole.
Json wall_at(const Walks& walks) {
  Eigen::Vector2d outward(0, 0), centre(0, 0);
  double length = 0;
  std::vector<Eigen::Vector2d> places;
  for (const auto& walk : walks)
    for (std::size_t k = 1; k < walk.size(); ++k) {
      const Eigen::Vector2d along = walk[k] - walk[k - 1], middle = (walk[k] + walk[k - 1]) / 2;
      outward += Eigen::Vector2d(along.y(), -along.x());
      centre += along.norm() * middle;
      length += along.norm();
      places.insert(places.end(), {walk[k - 1], middle, walk[k]});
    }
  constexpr double closed = 1e-3;
  if (outward.norm() < closed * length) {
    centre /= length;
    const auto distance = [&](const Eigen::Vector2d& p) { return (p - centre).norm(); };
    return {{"circle",
             {{"centre_mm", rounded(centre)},
              {"radius_mm", distance(*std::ranges::min_element(places, {}, distance))},
              {"bodies", "outside"}}}};
  }
  outward.normalize();
  const auto how_far = [&](const Eigen::Vector2d& p) { return p.dot(outward); };
  return {{"flat",
           {{"point_mm", rounded(*std::ranges::max_element(places, {}, how_far))},
            {"normal", rounded(-outward)}}}};
}

Json values_to_fill_in(const std::string& label, const Walks& walks) {
  switch (parse_boundary_label(label)->role) {
    case BoundaryRole::displacement:
      return {{"support", "full"}};  // a displacement would take the place of the scene's
    case BoundaryRole::force:
      return {{"traction_MPa", {0, 0}}};
    case BoundaryRole::contact:
      break;
  }
  return {{"friction", Scene().friction}, {"clearance_mm", 0}, {"wall", wall_at(walks)}};
}

void note_missing_roles(const Json& boundary, const std::string& name) {
  std::set<BoundaryRole> there;
  for (const auto& group : boundary.items()) there.insert(parse_boundary_label(group.key())->role);
  const auto note = [&](BoundaryRole role, const char* meaning) {
    if (there.contains(role)) return;
    const std::string_view word = boundary_role_names[static_cast<std::size_t>(role)];
    std::cerr << fmt::format(
        "note: {}: no curve has the role {}: {} (--role=CURVE={} next to --new-scene gives it)\n",
        name, word, meaning, word);
  };
  note(BoundaryRole::displacement, "it is held nowhere");
  note(BoundaryRole::contact, "it touches nothing");
}

}  // namespace

std::string new_scene_text(const std::filesystem::path& model, const Options& options) {
  const Json shown = parse_json(curves_of_model(model, options));
  const Material material;
  const Json of_material = {{"young_MPa", material.young_MPa}, {"poisson", material.poisson}};
  Json roles = Json::object(), boundary = Json::object(), materials = Json::object();
  std::vector<std::pair<std::string, Walks>> groups;
  for (const Json& curve : shown["curves"]) {
    const std::string label = label_of(curve);
    const std::vector<std::string> names = curve["names"];
    if (std::ranges::find(names, label) == names.end())
      roles[names.empty() ? std::to_string(curve["number"].get<int>()) : names.front()] = label;
    auto group = std::ranges::find(groups, label, [](const auto& g) { return g.first; });
    if (group == groups.end()) group = groups.insert(group, {label, {}});
    for (const Json& walk : curve["walks_mm"]) {
      auto& places = group->second.emplace_back();
      for (const Json& place : walk) places.emplace_back(place[0], place[1]);
    }
  }
  for (const auto& [label, walks] : groups) boundary[label] = values_to_fill_in(label, walks);
  for (const Json& body : shown["bodies"]) materials[body.get<std::string>()] = of_material;
  note_missing_roles(boundary, model_name(model) + ".json");
  std::vector<std::string> lines = {
      fmt::format("\"length_unit\": {}", json_text(length_unit_of(options))),
      "\"plane\": \"strain\"",
      fmt::format("\"materials\": {}", in_lines(materials)),
      "\"displacement_mm\": [0, 0]",
      "\"body_force_N_per_mm3\": [0, 0]",
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
  const SignsOfLife signs("reading " + model.string());
  const std::string text = new_scene_text(model, options);
  refuse_if_there();
  write_file_atomically(name, text);
  return name;
}

}  // namespace airybench
