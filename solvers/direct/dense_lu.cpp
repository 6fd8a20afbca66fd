#include "solvers/direct/dense_lu.hpp"

#include <limits>

#include "solvers/direct/lapack.hpp"

namespace airybench {

Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b) {
  const auto n = static_cast<int>(A.rows());
  if (n == 0) return b;
  Eigen::VectorXi pivots(n);
  const int columns = 1;
  int info = 0;
  dgesv_(&n, &columns, A.data(), &n, pivots.data(), b.data(), &n, &info);
  if (info != 0) b.setConstant(std::numeric_limits<double>::quiet_NaN());
  return b;
}

}  // namespace airybench
