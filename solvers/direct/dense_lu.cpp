#include "solvers/direct/dense_lu.hpp"

#include <limits>
#include <utility>

#include "solvers/direct/lapack.hpp"

namespace airybench {

Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b) {
  constexpr int worth_rounding = 128;  // below, conversions cost what floats save
  const auto n = static_cast<int>(A.rows());
  if (n == 0) return b;
  Eigen::VectorXi pivots(n);
  const int columns = 1;
  int info = 0;
  if (n < worth_rounding) {
    dgesv_(&n, &columns, A.data(), &n, pivots.data(), b.data(), &n, &info);
  } else {
    Eigen::VectorXd x(n), residual(n);
    Eigen::VectorXf rounded(static_cast<Eigen::Index>(n) * (n + columns));
    int refinements = 0;
    dsgesv_(&n, &columns, A.data(), &n, pivots.data(), b.data(), &n, x.data(), &n, residual.data(),
            rounded.data(), &refinements, &info);
    b = std::move(x);
  }
  if (info != 0) b.setConstant(std::numeric_limits<double>::quiet_NaN());
  return b;
}

}  // namespace airybench
