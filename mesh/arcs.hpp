// Circular arcs of a boundary that its file gives as chords or parabolas.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench {

// Gives straight boundary edges of a valid mesh the arc that they are chords of: where five or more
// consecutive vertices of one group lie on a circle, within the rounding of their coordinates
// (coordinate_rounding.hpp; mm_per_unit: the file's unit), and no edge turns by more than a twelfth
// of the circle. Parabolas, the sides of quadratic elements, become arcs where two or more have
// their three points on a circle and turn by an eighth of it at most. Returns how many edges these
// are.
int recognise_arcs(Mesh& mesh, double mm_per_unit = 1);

}  // namespace airybench
