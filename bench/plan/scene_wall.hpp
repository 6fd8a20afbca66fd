// "wall" and "face" of a scene file (assembly/wall.hpp).
//
//   { "flat": { "point_mm": [0, 0], "normal": [0, 1] } }
//   { "circle": { "centre_mm": [0, 8], "radius_mm": 8, "bodies": "inside" } }
//   { "polyline": [[0, 0], [1, 0.1], [2, 0.4]] }, in a file also the name of one with a point per
//   line
#pragma once

#include <filesystem>

#include "bench/plan/scene_reader.hpp"

namespace airybench {

// A face has no "bodies": it is the body's own.
enum class Curve { wall, face };
// Reads one into the target, which must outlive the reading.
SceneReader::Setter set_wall(const SceneReader& reader, std::optional<Wall>& target, Curve kind);

// Puts the points of files in the place of their names, wherever `json` has a "polyline"; the files
// are looked for beside the scene's. Two numbers a line, x and y in mm, separated by a comma or
// spaces; empty lines, those that begin with '#', and a first line of two words are skipped. Throws
// SceneError.
void inline_polylines(Json& json, const std::filesystem::path& scene_file);

}  // namespace airybench
