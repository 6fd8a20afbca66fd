// Y = S X on lanes of right-hand sides, S symmetric and given by its lower triangle.
#pragma once

#include "assembly/airy_system.hpp"
#include "solvers/base/lanes.hpp"

namespace airybench {

void symmetric_product(const SparseColumns& lower, const LaneBlock& X, LaneBlock& Y);

// y += S x for lanes 1 and max_lanes; row-major.
template <int lanes>
void symmetric_product(const SparseColumns& lower, const double* x, double* y);

}  // namespace airybench
