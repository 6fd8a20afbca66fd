#include "verify/positive_definite.hpp"

#include <Eigen/Cholesky>

namespace airybench {

bool solve_positive_definite(Eigen::MatrixXd A, Eigen::Ref<Eigen::MatrixXd> X) {
  return solve_positive_definite_in_place(A, X);
}

bool solve_positive_definite_in_place(Eigen::Ref<Eigen::MatrixXd> A,
                                      Eigen::Ref<Eigen::MatrixXd> X) {
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(A);
  if (factor.info() != Eigen::Success) return false;
  factor.solveInPlace(X);
  return true;
}

}  // namespace airybench
