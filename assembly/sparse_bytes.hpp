// What a sparse matrix in compressed rows or columns takes, analytically.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>

namespace airybench {

// Values, inner indices, and where each row or column begins.
template <typename Scalar, int order>
std::size_t bytes_of(const Eigen::SparseMatrix<Scalar, order>& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(Scalar) + sizeof(int)) +
         static_cast<std::size_t>(matrix.outerSize() + 1) * sizeof(int);
}

}  // namespace airybench
