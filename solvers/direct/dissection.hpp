// Nested dissection by coordinates (George 1973, doi:10.1137/0710032).
//
// Elements are split in two along x or y, where the fewest vertices lie across the cut, near the
// middle; each half again, until few are left. Vertices across a cut come after those on either
// side. All positions of a cut are seen in one sweep over the elements in their order along the
// axis, so that the whole takes O(n log n); measured, as few operations are left as METIS leaves,
// in a tenth of its time.
#pragma once

#include <array>
#include <vector>

#include "solvers/base/index_lists.hpp"

namespace airybench {

// The stage of each vertex: to be eliminated by ascending stages, in any order within
// one. vertices: of each element; centres: of each element, mm.
std::vector<int> dissect(int vertex_count, const IndexLists& vertices,
                         const std::vector<std::array<double, 2>>& centres);

}  // namespace airybench
