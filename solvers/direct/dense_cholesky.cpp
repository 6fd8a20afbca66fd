#include "solvers/direct/dense_cholesky.hpp"

#include <cmath>

#include "solvers/base/solution.hpp"
#include "solvers/direct/lapack.hpp"

namespace airybench {

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name) {
  Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || !matrix.allFinite())
    throw Breakdown(name + " is not positive definite to rounding");
  return llt;
}

bool factorise_in_place(Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> A) {
  const auto n = static_cast<int>(A.rows()), stride = static_cast<int>(A.outerStride());
  if (n == 0) return true;
  if (n < 48) {  // where a call of LAPACK costs more than it saves
    const Eigen::LLT<decltype(A)> in_place(A);
    return in_place.info() == Eigen::Success && std::isfinite(A(n - 1, n - 1));
  }
  int info = 0;
  dpotrf_("L", &n, A.data(), &stride, &info, 1);
  return info == 0 && std::isfinite(A(n - 1, n - 1));
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
