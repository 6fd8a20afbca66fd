#include "bench/plan/published_case.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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

// Numbers, or a list of them: with one value "at_mm" is one point.
std::vector<double> read_values(const JsonValue& value) {
  if (value.json.is_number()) return {value.json.get<double>()};
  return value.as<std::vector<double>>("a number, or a list of them at as many points");
}
std::vector<Eigen::Vector2d> read_points(const JsonValue& value, bool is_list) {
  constexpr const char* allowed = "x and y, or a list of as many of these as there are values";
  std::vector<Eigen::Vector2d> points;
  if (is_list)
    for (const auto& [x, y] : value.as<std::vector<std::array<double, 2>>>(allowed))
      points.emplace_back(x, y);
  else
    points.emplace_back(
        Eigen::Map<const Eigen::Vector2d>(value.as<std::array<double, 2>>(allowed).data()));
  return points;
}

PublishedQuantity read_quantity(const JsonValue& value) {
  PublishedQuantity q;
  bool is_list = false;
  value.object(
      {text("name", q.name),
       {"value",
        [&](const JsonValue& given) {
          q.values = read_values(given);
          is_list = given.json.is_array();
        },
        true},
       text("unit", q.unit),
       text("of", q.of),
       text("formula", q.formula),
       optional_text("face", q.face),
       {"at_mm", [&](const JsonValue& at) { q.at_mm = read_points(at, is_list); }},
       number("times", q.times, false),
       {"allowed_percent", [&](const JsonValue& allowed) { q.allowed = percent(allowed); }, true},
       text("because", q.because)});
  if (q.values.empty() || (is_list && q.at_mm.size() != q.values.size()))
    value.at("at_mm", value.json.value("at_mm", Json())).fail("as many points as values");
  const JsonValue of = value.at("of", value.json["of"]);
  if (!q.face.empty() && !q.at_mm.empty())
    of.one_of(of_faces_at_points, std::identity(), ", of a face at a point");
  else if (!q.face.empty())
    of.one_of(of_faces, std::identity(), ", of a face");
  else if (!q.at_mm.empty())
    of.one_of(at_points, std::identity(), ", at a point");
  else
    of.one_of(of_parts, std::identity(), ", of the part");
  return q;
}

}  // namespace

double PublishedQuantity::largest() const {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

std::vector<Eigen::Vector2d> PublishedCase::points_mm() const {
  std::vector<Eigen::Vector2d> points;
  for (const PublishedQuantity& quantity : quantities)
    if (quantity.face.empty()) std::ranges::copy(quantity.at_mm, std::back_inserter(points));
  return points;
}

bool PublishedCase::asks_largest_stress() const {
  return std::ranges::any_of(quantities, [](const PublishedQuantity& quantity) {
    return quantity.of == "von_mises_MPa" || quantity.of == "principal_MPa";
  });
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
