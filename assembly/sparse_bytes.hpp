// Bytes of a sparse matrix in compressed rows or columns, from its counts.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>

namespace airybench {

template <typename Scalar, int order>
std::size_t bytes_of(const Eigen::SparseMatrix<Scalar, order>& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(Scalar) + sizeof(int)) +
         static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(int);
}

}  // namespace airybench
