// Small dense systems of a size that is known when the program runs: Eigen's, compiled once.
#pragma once

#include <Eigen/Core>

namespace airybench {

// X ← A⁻¹ X. A: symmetric; its lower triangle is read. False, and X stays, if A is not positive
// definite to rounding. In place: A becomes its factor.
bool solve_positive_definite(Eigen::MatrixXd A, Eigen::Ref<Eigen::MatrixXd> X);
bool solve_positive_definite_in_place(Eigen::Ref<Eigen::MatrixXd> A, Eigen::Ref<Eigen::MatrixXd> X);

}  // namespace airybench
