// Files of NumPy: numpy.load() and scipy.sparse.load_npz() read them.
//
// A .npz is a zip of .npy files: a line of text with type, order and shape, then the numbers as
// they are in memory (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#pragma once

#include <string>
#include <vector>

#include "bench/problems/problem_arrays.hpp"

namespace airybench {

// Dense arrays under their names.
std::string npz_of_arrays(const std::vector<const ProblemArray*>& arrays);
// A sparse matrix in compressed rows, as scipy.sparse.save_npz() writes it.
std::string npz_of_sparse(const SparseRows& matrix);

}  // namespace airybench
