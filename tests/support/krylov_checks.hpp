// What conjugate gradients and SYMMLQ are tested for alike.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/dense_operators.hpp"

namespace airybench::testing {

inline KrylovOptions with(double tolerance, int lanes = 1, int threads = 1) {
  KrylovOptions options;
  options.tolerance = tolerance;
  options.lanes = lanes;
  options.threads = threads;
  options.most_iterations = 500;
  return options;
}

// X ← A⁻¹ X for a dense A.
using DenseSolve = std::function<KrylovSummary(const Eigen::MatrixXd& A, const Preconditioner& M,
                                               Eigen::MatrixXd& X, const KrylovOptions& options)>;

// The same for every right-hand side alone, for any number of lanes and threads.
inline void expect_alike(const DenseSolve& solve, const Eigen::MatrixXd& A,
                         const Preconditioner& preconditioner, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd alone = B;
  KrylovSummary sum;
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    Eigen::MatrixXd X = B.col(k);
    const KrylovSummary one = solve(A, preconditioner, X, with(1e-7));
    alone.col(k) = X;
    sum.iterations += one.iterations;
    sum.most_iterations = std::max(sum.most_iterations, one.most_iterations);
    if (k == 0) sum.history = one.history;
  }
  EXPECT_LT(sum.most_iterations, A.rows());
  for (const int lanes : {1, most_lanes})
    for (const int threads : {1, 2, 5}) {
      Eigen::MatrixXd X = B;
      const KrylovSummary summary = solve(A, preconditioner, X, with(1e-7, lanes, threads));
      EXPECT_TRUE(summary.converged);
      EXPECT_EQ(summary.iterations, sum.iterations) << lanes << " lanes, " << threads << " threads";
      EXPECT_EQ(summary.most_iterations, sum.most_iterations);
      EXPECT_EQ(summary.history.size(), sum.history.size());
      EXPECT_LT((X - alone).norm(), 1e-11 * alone.norm());
    }
}

// On a random matrix with so many negative eigenvalues, and right-hand sides that take from none to
// many iterations.
inline void expect_neighbours_change_nothing(const DenseSolve& solve, int negative) {
  std::mt19937 generator(7);
  // Large enough to converge long before rounding decides when.
  const int n = 150, count = 53;
  const Spectral A(random_spectrum(n, negative, generator), generator);
  const Spectral M(random_spectrum(n, 0, generator).cwiseSqrt().cwiseSqrt(), generator);
  Eigen::MatrixXd B = random_matrix(n, count, generator);
  for (int k = 0; k < count; k += 7)  // 1 to 5 iterations without M
    B.col(k) = 1e3 * A.Q.leftCols(1 + k % 5).rowwise().sum();
  B.col(20).setZero();
  for (const Preconditioner& preconditioner : {no_preconditioner(), preconditioner_of(M.inverse())})
    expect_alike(solve, A.matrix(), preconditioner, B);
}

}  // namespace airybench::testing
