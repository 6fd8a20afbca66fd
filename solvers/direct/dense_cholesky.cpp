#include "solvers/direct/dense_cholesky.hpp"

#include "solvers/base/solution.hpp"

namespace airybench {

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name) {
  Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || !matrix.allFinite())
    throw Breakdown(name + " is not positive definite to rounding");
  return llt;
}

}  // namespace airybench
