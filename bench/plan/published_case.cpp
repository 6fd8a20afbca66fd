#include "bench/plan/published_case.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>

#include "bench/records/json_value.hpp"
#include "mesh/selection.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr std::array of_faces = {"pressure_MPa", "normal_N",    "tangential_N",
                                 "closed_mm",    "slipping_mm", "length_mm"};
constexpr std::array of_faces_at_points = {"pressure_MPa", "shear_MPa", "gap_mm", "slip_mm"};
constexpr std::array at_points = {"sxx_MPa", "syy_MPa", "sxy_MPa", "ux_mm", "uy_mm"};
constexpr std::array of_parts = {"von_mises_MPa", "principal_MPa", "displacement_mm",
                                 "strain_energy_Nmm"};

JsonKey text(const char* name, std::string& target) {
  return {name, [&target](const JsonValue& value) { target = value.as<std::string>("a text"); },
          true};
}
JsonKey optional_text(const char* name, std::string& target) {
  JsonKey key = text(name, target);
  key.is_required = false;
  return key;
}
JsonKey number(const char* name, double& target, bool is_required = true) {
  return {name, [&target](const JsonValue& value) { target = value.as<double>("a number"); },
          is_required};
}

double percent(const JsonValue& value) {
  const double given = value.as<double>("a number of per cent, 0 to 100");
  if (!(given >= 0 && given < 100)) value.fail("a number of per cent, 0 to 100");
  return given / 100;
}

PublishedQuantity read_quantity(const JsonValue& value) {
  PublishedQuantity q;
  value.object(
      {text("name", q.name),
       number("value", q.value),
       text("unit", q.unit),
       text("of", q.of),
       text("formula", q.formula),
       optional_text("face", q.face),
       {"at_mm",
        [&q](const JsonValue& at) {
          const auto xy = at.as<std::array<double, 2>>("two numbers");
          q.at_mm = Eigen::Vector2d(xy[0], xy[1]);
        }},
       number("times", q.times, false),
       {"allowed_percent", [&q](const JsonValue& allowed) { q.allowed = percent(allowed); }, true},
       text("because", q.because)});
  const JsonValue of = value.at("of", value.json["of"]);
  if (!q.face.empty() && q.at_mm)
    of.one_of(of_faces_at_points, std::identity(), ", of a face at a point");
  else if (!q.face.empty())
    of.one_of(of_faces, std::identity(), ", of a face");
  else if (q.at_mm)
    of.one_of(at_points, std::identity(), ", at a point");
  else
    of.one_of(of_parts, std::identity(), ", of the part");
  return q;
}

}  // namespace

std::vector<Eigen::Vector2d> PublishedCase::points_mm() const {
  std::vector<Eigen::Vector2d> points;
  for (const PublishedQuantity& quantity : quantities)
    if (quantity.at_mm && quantity.face.empty()) points.push_back(*quantity.at_mm);
  return points;
}

PublishedCase read_published_case(const std::filesystem::path& file) {
  const Json json = json_of_file(file.string(), file_text(file));
  PublishedCase read;
  read.name = file.stem().string();
  std::string model;
  JsonValue(file.string(), "", json)
      .object({text("title", read.title),
               text("source", read.source),
               text("model", model),
               {"scene",
                [&](const JsonValue& scene) {
                  read.scene = scene_file_of(json_text(scene.json), file.string() + ": scene");
                  read.scene->scene.name = read.name;
                }},
               {"error_percent", [&](const JsonValue& value) { read.error = percent(value); }},
               optional_text("degree", read.degree),
               {"quantities",
                [&](const JsonValue& list) {
                  if (!list.json.is_array() || list.json.empty()) list.fail("a list");
                  for (std::size_t k = 0; k < list.json.size(); ++k)
                    read.quantities.push_back(read_quantity(list.item(k)));
                },
                true}});
  read.model = is_mesh_file(model) ? file.parent_path() / model : std::filesystem::path(model);
  return read;
}

std::vector<PublishedCase> published_cases(const std::string& selection) {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(data_folder("validation")))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) names.push_back(file.stem().string());
  std::vector<bool> is_chosen(files.size(), selection.empty());
  for (const std::string& glob :
       selection.empty() ? std::vector<std::string>() : split_list(selection)) {
    bool any = false;
    for (std::size_t k = 0; k < files.size(); ++k)
      if (fnmatch(glob.c_str(), names[k].c_str(), 0) == 0) any = is_chosen[k] = true;
    if (!any)
      throw UsageError(
          fmt::format("CASE: {} (allowed: {})", shortened(glob), fmt::join(names, ", ")));
  }
  std::vector<PublishedCase> cases;
  for (std::size_t k = 0; k < files.size(); ++k)
    if (is_chosen[k]) cases.push_back(read_published_case(files[k]));
  return cases;
}

}  // namespace airybench
