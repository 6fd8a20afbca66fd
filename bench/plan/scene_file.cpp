#include "bench/plan/scene_file.hpp"

#include <sstream>

#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "support/file_text.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {

void read(const JsonValue& value, SceneFile& file);  // scene_keys.cpp

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
  file.definition = json_text(json);
  read(JsonValue(place, "", json), file);
  if (json.contains("wall") && !json.value("crown_radius_mm", Json()).is_null())
    throw FileError(place + ": wall and crown_radius_mm (allowed: one of them)");
  check_values(file.scene);
  return file;
}

}  // namespace

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
  Json json = parse_json(file.definition);
  json["load_steps"] = steps;
  file.scene.equal_steps = steps;
  file.definition = json_text(json);
  return file;
}

SceneFile on_other_bodies(SceneFile file) {
  Json json = parse_json(file.definition);
  if (json.contains("crown_radius_mm") || json.contains("wall")) return file;
  file.scene.crown_radius_mm.reset();
  json["crown_radius_mm"] = nullptr;
  file.definition = json_text(json);
  return file;
}

}  // namespace airybench
