// Where straight edges look like a curve that their mesh does not know.
//
// Of consecutive edges of one group, those in line are one side. Five or more sides of similar
// length that all bend the same way, by less than 36° each, are taken for chords of a curve, if the
// curvature 2τ/(L + L′) changes by less than a factor 2.5 from one vertex to the next. Between
// sides of lengths L and L′ that turn by τ it is tangent at τ L/(L + L′) from the first, as a
// circle through their ends would be.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

struct SupposedCurve {
  int boundary_row;
  double side_mm;             // the side that the edge is, or is a part of
  double from_rad, to_rad;    // of the curve to the edge, at its start and end; linear between
  double sagitta_mm() const;  // of the side
};

// Of edges that have no curve of their own.
std::vector<SupposedCurve> supposed_curves(const Mesh& mesh);

}  // namespace airybench
