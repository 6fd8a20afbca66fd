// Random symmetric matrices with known spectra, as the Krylov solvers take them.
#pragma once

#include <Eigen/Core>
#include <random>

#include "assembly/airy_system.hpp"
#include "solvers/krylov/symmlq.hpp"
#include "solvers/preconditioners/preconditioner.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::testing {

inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns,
                                     std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

// Q diag(eigenvalues) Qᵀ with a random orthogonal Q, and its pseudoinverse.
struct Spectral {
  Eigen::MatrixXd Q;
  Eigen::VectorXd eigenvalues;

  Spectral(Eigen::VectorXd of, std::mt19937& generator) : eigenvalues(std::move(of)) {
    const Eigen::Index n = eigenvalues.size();
    Q = orthogonal_factor(random_matrix(n, n, generator));
  }
  Eigen::MatrixXd matrix() const { return with_eigenvalues(Q, eigenvalues); }
  Eigen::MatrixXd inverse() const { return with_eigenvalues(Q, reciprocals()); }
  Eigen::MatrixXd absolute_inverse() const { return with_eigenvalues(Q, reciprocals().cwiseAbs()); }

 private:
  Eigen::VectorXd reciprocals() const {
    Eigen::VectorXd values = eigenvalues;
    for (double& value : values) value = value == 0 ? 0 : 1 / value;
    return values;
  }
};

// n values between 0.5 and 2, the first `negative` of them with a minus.
inline Eigen::VectorXd random_spectrum(int n, int negative, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0.5, 2);
  Eigen::VectorXd values = Eigen::VectorXd::NullaryExpr(n, [&] { return uniform(generator); });
  values.head(negative) *= -1;
  return values;
}

inline SymmetricOperator operator_of(const Eigen::MatrixXd& A) {
  return {A.rows(), [A](const LaneBlock& X, LaneBlock& Y) { Y.noalias() = A * X; }};
}

inline SparseColumns lower_of(const Eigen::MatrixXd& A) {
  return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
}

// [S Cᵀ; C 0] with C = [C_F; C_C].
inline Eigen::MatrixXd saddle_matrix(const AirySystem& system) {
  const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + n_f + n_c, n + n_f + n_c);
  M.topLeftCorner(n, n) = Eigen::MatrixXd(system.S).selfadjointView<Eigen::Lower>();
  M.block(n, 0, n_f, n) = system.C_F;
  M.block(n + n_f, 0, n_c, n) = system.C_C;
  M.topRightCorner(n, n_f + n_c) = M.bottomLeftCorner(n_f + n_c, n).transpose();
  return M;
}

// M⁻¹ as a dense matrix.
inline Preconditioner preconditioner_of(const Eigen::MatrixXd& inverse) {
  Preconditioner result;
  result.applier = [inverse](int) -> Apply {
    return [inverse](LaneBlock& X) { X = (inverse * X).eval(); };
  };
  return result;
}

inline Preconditioner no_preconditioner() { return preconditioner_named("NONE")({}, {}); }

inline KrylovOptions with(double tolerance, int lanes = 1, int threads = 1) {
  KrylovOptions options;
  options.tolerance = tolerance;
  options.lanes = lanes;
  options.threads = threads;
  options.max_iterations = 500;
  return options;
}

// ‖R‖_M⁻¹ of every column.
inline Eigen::VectorXd norms(const Eigen::MatrixXd& inverse, const Eigen::MatrixXd& R) {
  return (R.transpose() * inverse * R).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace airybench::testing
