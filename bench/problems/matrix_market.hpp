// The Matrix Market exchange format, https://math.nist.gov/MatrixMarket/formats.html: coordinate
// (sparse) or array (dense, by columns), real or integer, lower triangle of a symmetric matrix.
// Numbers read back to the last bit.
#pragma once

#include <string>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

std::string matrix_market_text(const ProblemArray& array);

}  // namespace airybench
