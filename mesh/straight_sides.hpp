// Straight sides of a mesh whose file rounds its coordinates.
//
// With 7 digits a straight side that follows no axis bends at every vertex, by 1e-4 where its edges
// are short. Rollers of two directions hold their common vertex fully, so a side that should slide
// would be clamped.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench {

struct MovedVertices {
  int count = 0;
  double furthest_mm = 0;
  std::string words() const;  // for a note
};

// Moves the vertices between displacement edges, or force edges, of a valid mesh onto the line
// between the corners of their side, if all of them are within the rounding of coordinates from it.
// A corner is further than that from the line through its neighbours. Coordinates are rounded if
// those where edges bend, divided by mm_per_unit, have 6 to 10 digits or are in single precision.
// Contact edges, which gaps are measured from, stay, and so does all where a triangle would turn.
MovedVertices straighten_sides(Mesh& mesh, double mm_per_unit = 1);

}  // namespace airybench
