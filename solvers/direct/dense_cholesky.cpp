#include "solvers/direct/dense_cholesky.hpp"

#include "solvers/base/solution.hpp"

// OpenBLAS has LAPACK in it, but brings no header for it.
extern "C" void dpotri_(const char* triangle, const int* n, double* matrix, const int* stride,
                        int* info, std::size_t length_of_triangle);

namespace airybench {

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name) {
  Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || !matrix.allFinite())
    throw Breakdown(name + " is not positive definite to rounding");
  return llt;
}

Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L) {
  const int n = static_cast<int>(L.rows());
  int info = 0;
  if (n > 0) dpotri_("L", &n, L.data(), &n, &info, 1);
  if (info != 0)
    throw Breakdown("dense Cholesky factor: zero at " + std::to_string(info) + " on its diagonal");
  for (int j = 0; j < n; ++j) L.row(j).tail(n - j - 1) = L.col(j).tail(n - j - 1).transpose();
  return L;
}

}  // namespace airybench
