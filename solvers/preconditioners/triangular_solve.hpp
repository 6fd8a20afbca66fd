// Triangular solves with sparse factors on lanes of right-hand sides.
#pragma once

#include <vector>

#include "solvers/base/lanes.hpp"

namespace airybench {

// Rows [first, first + start.size() − 1) of a lower triangular matrix, without the diagonal.
struct FactorRows {
  int first = 0;
  std::vector<int> start = {0};  // of each row in column and value, and the end
  std::vector<int> column;       // ascending in a row
  std::vector<double> value;
};

// L of M = L Lᵀ, in parts so that it can grow without being copied.
struct IncompleteFactor {
  std::vector<FactorRows> parts;  // in order
  std::vector<double> inverse_diagonal;
  double flops = 0;             // additions and multiplications that made it
  std::size_t entries() const;  // with the diagonal
  std::size_t bytes() const;
};

// X ← L⁻ᵀ L⁻¹ X.
void solve_in_place(const IncompleteFactor& factor, LaneBlock& X);

}  // namespace airybench
