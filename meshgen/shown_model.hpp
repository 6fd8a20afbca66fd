// A model for its user: as a table of curves, and as JSON for a drawing.
#pragma once

#include <string>

#include "meshgen/plane_model.hpp"

namespace airybench {

// The curves on the boundary: number, names, role, length, ends, middle. Lines are indented.
std::string table_of(const PlaneModel& model);

// {"model", "bodies": [name], "vertices_mm": [[x, y]], "triangles": [[vertex, vertex, vertex]],
//  "curves": [{"number", "names", "role", "walks_mm": [[[x, y]]]}]}, those on the boundary.
std::string json_of(const PlaneModel& model, const std::string& name);

}  // namespace airybench
