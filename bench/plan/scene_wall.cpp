#include "bench/plan/scene_wall.hpp"

#include <optional>
#include <sstream>

#include "support/file_text.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

FlatWall read_flat(const SceneReader& reader, const std::string& key, const Json& json) {
  FlatWall wall{{0, 0}, {0, 0}};
  reader.object(
      key + ": ", json,
      {{"point_mm", [&](const auto& k, const Json& v) { wall.point_mm = reader.vector(k, v); }},
       {"normal", [&](const auto& k, const Json& v) { wall.normal = reader.vector(k, v); }}});
  if (!json.contains("point_mm") || !json.contains("normal"))
    reader.fail(key, json, "{\"point_mm\": [x, y], \"normal\": [x, y]}, both given");
  return wall;
}

CircularWall read_circle(const SceneReader& reader, const std::string& key, const Json& json,
                         Curve kind) {
  using enum CircularWall::Bodies;
  CircularWall wall{{0, 0}, 0, inside};
  std::vector<std::pair<std::string, SceneReader::Setter>> keys = {
      {"centre_mm", [&](const auto& k, const Json& v) { wall.centre_mm = reader.vector(k, v); }},
      {"radius_mm", [&](const auto& k, const Json& v) { wall.radius_mm = reader.positive(k, v); }}};
  if (kind == Curve::wall)
    keys.emplace_back("bodies", [&](const std::string& k, const Json& v) {
      if (v != "inside" && v != "outside") reader.fail(k, v, "\"inside\" or \"outside\"");
      wall.bodies = v == "inside" ? inside : outside;
    });
  reader.object(key + ": ", json, keys);
  for (const auto& [name, set] : keys)
    if (!json.contains(name))
      reader.fail(key, json,
                  kind == Curve::wall
                      ? "{\"centre_mm\": [x, y], \"radius_mm\": ..., \"bodies\": \"inside\" or "
                        "\"outside\"}, all given"
                      : "{\"centre_mm\": [x, y], \"radius_mm\": ...}, both given");
  return wall;
}

PolylineWall read_polyline(const SceneReader& reader, const std::string& key, const Json& json) {
  if (!json.is_array())
    reader.fail(key, json, "a list of points [x, y], or in a file a file's name");
  PolylineWall wall;
  for (const Json& point : json) wall.points_mm.push_back(reader.vector(key, point));
  return wall;
}

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

Json points_of(const std::filesystem::path& file, const std::string& place) {
  std::string text;
  try {
    text = file_text(file);
  } catch (const FileError& error) {
    throw SceneError(place + ": polyline: " + error.what());
  }
  Json points = Json::array();
  std::istringstream lines(text);
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

Wall read_wall(const SceneReader& reader, const std::string& key, const Json& json, Curve kind) {
  std::optional<Wall> wall;
  reader.object(
      key + ": ", json,
      {{"flat", [&](const auto& k, const Json& v) { wall = read_flat(reader, k, v); }},
       {"circle", [&](const auto& k, const Json& v) { wall = read_circle(reader, k, v, kind); }},
       {"polyline", [&](const auto& k, const Json& v) { wall = read_polyline(reader, k, v); }}});
  if (json.size() != 1) reader.fail(key, json, "one of flat, circle, polyline");
  return *wall;
}

}  // namespace

SceneReader::Setter set_wall(const SceneReader& reader, std::optional<Wall>& target, Curve kind) {
  return [&reader, &target, kind](const std::string& key, const Json& json) {
    target = read_wall(reader, key, json, kind);
  };
}

void inline_polylines(Json& json, const std::filesystem::path& scene_file) {
  if (!json.is_structured()) return;
  for (auto& [key, value] : json.items())
    if (json.is_object() && key == "polyline" && value.is_string())
      value = points_of(scene_file.parent_path() / value.get<std::string>(), scene_file.string());
    else
      inline_polylines(value, scene_file);
}

}  // namespace airybench
