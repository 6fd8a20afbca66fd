// The Matrix Market exchange format, https://math.nist.gov/MatrixMarket/formats.html: coordinate
// (sparse) and array (dense, by columns), real or integer, of a symmetric matrix the lower
// triangle. Numbers are written so that they come back to the last bit.
#pragma once

#include <string>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

std::string matrix_market_text(const ProblemArray& array);

}  // namespace airybench
