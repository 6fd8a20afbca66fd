#include "bench/plan/scene_file.hpp"

#include <sstream>

#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "mesh/model_settings.hpp"
#include "support/file_text.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {

// scene_keys.cpp
void read_keys(const JsonValue& value, SceneFile& file);
Json scene_json(SceneFile file);

namespace {

std::optional<Eigen::Vector2d> point_of(std::string line) {
  std::ranges::replace(line, ',', ' ');
  std::istringstream words(line);
  std::string x, y, rest;
  if (!(words >> x >> y) || words >> rest) return {};
  const std::optional<double> first = parse_number(x), second = parse_number(y);
  if (!first || !second) return {};
  return Eigen::Vector2d(*first, *second);
}

bool is_header(const std::string& line) {
  return line.find_first_of("0123456789") == line.npos && line.find_first_of(", ") != line.npos;
}

// Reads lines "x y" or "x, y" in mm; skips empty lines, '#' lines and a header without digits.
Json points_of(const std::filesystem::path& file, const std::string& place) {
  Json points = Json::array();
  std::istringstream lines;
  try {
    lines.str(file_text(file));
  } catch (const FileError& error) {
    throw FileError(place + ": polyline: " + error.what());
  }
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.find_first_not_of(" \t") == line.npos || line.starts_with('#')) continue;
    if (points.empty() && is_header(line)) continue;
    const std::optional<Eigen::Vector2d> point = point_of(line);
    if (!point)
      throw FileError(fmt::format("{}: polyline: {}:{}: '{}' (allowed: two numbers, x and y in mm)",
                                  place, file.string(), number, shortened(line)));
    points.push_back({point->x(), point->y()});
  }
  return points;
}

// The points of a polyline's file stand for its name: a record has all of its scene.
void inline_polylines(Json& json, const std::filesystem::path& scene_file) {
  if (!json.is_structured()) return;
  for (auto& [key, value] : json.items())
    if (json.is_object() && key == "polyline" && value.is_string())
      value = points_of(scene_file.parent_path() / value.get<std::string>(), scene_file.string());
    else
      inline_polylines(value, scene_file);
}

SceneFile checked_scene(const Json& json, const std::string& place) {
  SceneFile file;
  file.scene.source = place;
  read_keys(JsonValue(place, "", json), file);
  for (const auto& key : json.items()) file.keys.insert(key.key());
  if (file.scene.wall && file.keys.contains("crown_radius_mm") && file.scene.crown_radius_mm)
    throw FileError(place + ": wall and crown_radius_mm (allowed: one of them)");
  check_values(file.scene);
  return file;
}

}  // namespace

std::vector<std::string> SceneFile::model_settings() const {
  std::vector<std::string> settings;
  for (const auto& [curves, label] : roles)
    settings.push_back(fmt::format("{}={}={}", role_setting.option, curves, label));
  if (length_unit != "mm")
    settings.push_back(fmt::format("{}={}", length_unit_setting.option, length_unit));
  return settings;
}

std::string SceneFile::definition() const { return json_text(scene_json(*this)); }

std::string SceneFile::text() const {
  const Json json = scene_json(*this);
  std::vector<std::string> lines;
  for (const auto& [key, value] : json.items()) {
    std::vector<std::string> inner;
    if (value.is_object())
      for (const auto& [name, of_name] : value.items())
        inner.push_back(fmt::format("    {}: {}", json_text(name), json_text(of_name)));
    lines.push_back(fmt::format(
        "  {}: {}", json_text(key),
        inner.empty() ? json_text(value) : fmt::format("{{\n{}\n  }}", fmt::join(inner, ",\n"))));
  }
  return fmt::format("{{\n{}\n}}\n", fmt::join(lines, ",\n"));
}

SceneFile scene_file_of(const std::string& text, const std::string& place) {
  return checked_scene(json_of_file(place, text), place);
}

Scene scene_of(const std::string& text, const std::string& place) {
  return scene_file_of(text, place).scene;
}

SceneFile read_scene_file(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  if (!is_name(name))
    throw FileError(shortened(file.string()) +
                    ": a scene is named as its file (allowed: UTF-8 without "
                    "control characters)");
  Json json = json_of_file(file.string(), file_text(file));
  inline_polylines(json, file);
  SceneFile checked = checked_scene(json, file.string());
  checked.scene.name = name;
  return checked;
}

Scene read_scene(const std::filesystem::path& file) { return read_scene_file(file).scene; }

SceneFile in_equal_steps(SceneFile file, int steps) {
  if (file.scene.equal_steps != 1 || !file.scene.later_steps.empty())
    throw FileError(
        fmt::format("{}: load_steps and --steps (allowed: one of them)", file.scene.source));
  file.scene.equal_steps = steps;
  file.keys.insert("load_steps");
  return file;
}

SceneFile on_other_bodies(SceneFile file) {
  if (file.scene.wall || !file.keys.insert("crown_radius_mm").second) return file;
  file.scene.crown_radius_mm.reset();
  return file;
}

}  // namespace airybench
