// Dense linear algebra for tests, LAPACK's: Eigen's takes the compiler seconds wherever one of its
// decompositions is named, and minutes of the processor where it is not optimised.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace airybench::testing {

// ‖A − B‖, Frobenius.
double distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

// ‖A X − B‖, Frobenius.
double residual(const Eigen::MatrixXd& A, const Eigen::MatrixXd& X, const Eigen::MatrixXd& B);

// Ascending; of A, which is symmetric, the lower triangle is read.
Eigen::VectorXd eigenvalues(Eigen::MatrixXd A);

// Q diag(values) Qᵀ, symmetric to the last bit.
Eigen::MatrixXd with_eigenvalues(const Eigen::MatrixXd& Q, const Eigen::VectorXd& values);

// Q of A = Q R; A has no more columns than rows.
Eigen::MatrixXd orthogonal_factor(Eigen::MatrixXd A);

// L of A = L Lᵀ; of A, which is symmetric positive definite, the lower triangle is read.
Eigen::MatrixXd cholesky_factor(Eigen::MatrixXd A);

// B → A⁻¹ B by LU with row exchanges; the factors are kept.
std::function<Eigen::MatrixXd(Eigen::MatrixXd B)> factorised(Eigen::MatrixXd A);
Eigen::MatrixXd solved(Eigen::MatrixXd A, Eigen::MatrixXd B);

// x that makes ‖A x − b‖ smallest; A has full column rank.
Eigen::VectorXd least_squares(Eigen::MatrixXd A, Eigen::VectorXd b);

// By QR with column exchanges: |R_ii| above min(rows, columns) ε |R_11|.
int rank(Eigen::MatrixXd A);

}  // namespace airybench::testing
