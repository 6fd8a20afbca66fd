// NumPy files, for numpy.load() and scipy.sparse.load_npz(). A .npz is a zip of .npy files: a line
// of text with type, order and shape, then the numbers as in memory
// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#pragma once

#include <string>
#include <vector>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

std::string npz_of_arrays(const std::vector<const ProblemArray*>& arrays);
// In compressed rows, as by scipy.sparse.save_npz().
std::string npz_of_sparse(const SparseRows& matrix);

}  // namespace airybench
