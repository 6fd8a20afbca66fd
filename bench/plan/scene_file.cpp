#include "bench/plan/scene_file.hpp"

#include <set>
#include <sstream>

#include "bench/plan/scene_value.hpp"
#include "bench/records/case_name.hpp"
#include "support/file_text.hpp"
#include "support/numbers.hpp"

namespace airybench {
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

std::string text_of(const std::filesystem::path& file, const std::string& place) {
  try {
    return file_text(file);
  } catch (const FileError& error) {
    throw SceneError(place + error.what());
  }
}

// Reads lines "x y" or "x, y" in mm; skips empty lines, '#' lines and a header without digits.
Json points_of(const std::filesystem::path& file, const std::string& place) {
  Json points = Json::array();
  std::istringstream lines(text_of(file, place + ": polyline: "));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.find_first_not_of(" \t") == line.npos || line.starts_with('#')) continue;
    if (points.empty() && is_header(line)) continue;
    const std::optional<Eigen::Vector2d> point = point_of(line);
    if (!point)
      throw SceneError(
          fmt::format("{}: polyline: {}:{}: '{}' (allowed: two numbers, x and y in mm)", place,
                      file.string(), number, shortened(line)));
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

Json json_of(const std::string& text, const std::string& place) {
  constexpr std::size_t most_keys = 1000;
  // JSON allows repeated keys; a scene does not.
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > 8) throw SceneError(place + ": nested more than 8 deep");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && keys.back().size() == most_keys)
      throw SceneError(fmt::format("{}: more than {} keys in one object", place, most_keys));
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw SceneError(place + ": " + shortened(value.get<std::string>()) + ": given twice");
    return true;
  };
  if (text.find('\0') != text.npos)  // the parser would stop there
    throw SceneError(place + ": not JSON: a zero byte");
  try {
    return Json::parse(text, watch);
  } catch (const Json::exception& wrong) {
    throw SceneError(place + ": not JSON: " + without_prefix(wrong));
  }
}

Scene checked_scene(const Json& json, const std::string& place) {
  Scene scene;
  scene.source = place;
  read(SceneValue(place, "", json), scene);
  if (json.contains("wall") && json.contains("crown_radius_mm"))
    throw SceneError(place + ": wall and crown_radius_mm (allowed: one of them)");
  read_model_settings(SceneValue(place, "", json));
  check_values(scene);
  return scene;
}

}  // namespace

Scene scene_of(const std::string& text, const std::string& place) {
  return checked_scene(json_of(text, place), place);
}

SceneFile read_scene_file(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  if (!is_name(name))
    throw SceneError(shortened(file.string()) +
                     ": a scene is named as its file (allowed: UTF-8 without "
                     "control characters)");
  Json json = json_of(text_of(file, ""), file.string());
  inline_polylines(json, file);
  Scene scene = checked_scene(json, file.string());
  scene.name = name;
  return {std::move(scene), json_text(json),
          read_model_settings(SceneValue(file.string(), "", json))};
}

Scene read_scene(const std::filesystem::path& file) { return read_scene_file(file).scene; }

SceneFile on_other_bodies(SceneFile file) {
  Json json = parse_json(file.definition);
  if (json.contains("crown_radius_mm") || json.contains("wall")) return file;
  file.scene.crown_radius_mm.reset();
  json["crown_radius_mm"] = nullptr;
  file.definition = json_text(json);
  return file;
}

}  // namespace airybench
