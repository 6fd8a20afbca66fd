#include "solvers/krylov/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "solvers/base/blas_library.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/krylov_checks.hpp"

namespace airybench::conjugate_gradients_test {
namespace {

using namespace testing;

// X ← S⁻¹ X.
KrylovSummary solve(const Eigen::MatrixXd& S, const Preconditioner& M, Eigen::MatrixXd& X,
                    const KrylovOptions& options, const Deadline& deadline = {}) {
  return solve_by_conjugate_gradients(lower_of(S), M, columns_of(X), options, deadline);
}

TEST(ConjugateGradients, SolvesWithAndWithoutAPreconditioner) {
  std::mt19937 generator(1);
  for (const int n : {1, 2, 3, 7, 40})
    for (const int lanes : {1, most_lanes}) {
      const Spectral S(random_spectrum(n, 0, generator), generator);
      const Spectral M(random_spectrum(n, 0, generator), generator);
      const Eigen::MatrixXd B = random_matrix(n, 5, generator);
      for (const Preconditioner& preconditioner :
           {no_preconditioner(), preconditioner_of(M.inverse())}) {
        Eigen::MatrixXd X = B;
        EXPECT_TRUE(solve(S.matrix(), preconditioner, X, with(1e-14, lanes)).converged) << n;
        EXPECT_LT(testing::distance(X, S.inverse() * B), 1e-12 * X.norm()) << n << ", " << lanes;
      }
    }
}

TEST(ConjugateGradients, ReadsTheLowerTriangleOfASparseMatrixOnly) {
  // A tridiagonal matrix whose other entries are not stored.
  const int n = 50;
  SparseColumns lower(n, n);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    lower.insert(i, i) = S(i, i) = 3 + i % 4;
    if (i + 1 < n) lower.insert(i + 1, i) = S(i + 1, i) = S(i, i + 1) = -1 - 0.1 * (i % 3);
  }
  lower.makeCompressed();
  for (const int lanes : {1, most_lanes}) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd X = B;
    solve_by_conjugate_gradients(lower, no_preconditioner(), columns_of(X), with(1e-14, lanes));
    EXPECT_LT(testing::residual(S, X, B), 1e-12);
  }
}

TEST(ConjugateGradients, EndsAfterAsManyIterationsAsThereAreDifferentEigenvalues) {
  std::mt19937 generator(2);
  const std::vector<double> all = {3, 1, 0.5, 2, 1.5, 4};
  for (std::size_t different = 1; different <= all.size(); ++different) {
    Eigen::VectorXd eigenvalues(30);
    for (int i = 0; i < 30; ++i) eigenvalues(i) = all[i % different];
    Eigen::MatrixXd X = random_matrix(30, 1, generator);
    const KrylovSummary summary =
        solve(Spectral(eigenvalues, generator).matrix(), no_preconditioner(), X, with(1e-9));
    EXPECT_TRUE(summary.converged);
    EXPECT_EQ(summary.iterations, static_cast<std::int64_t>(different));
  }
}

TEST(ConjugateGradients, TheMatrixItselfIsPreconditionerForOneIteration) {
  std::mt19937 generator(3);
  const Spectral S(1e4 * random_spectrum(30, 0, generator), generator);
  Eigen::MatrixXd X = random_matrix(30, 4, generator);
  const KrylovSummary summary = solve(S.matrix(), preconditioner_of(S.inverse()), X, with(1e-10));
  EXPECT_EQ(summary.most_iterations, 1);
  EXPECT_EQ(summary.iterations, 4);
}

TEST(ConjugateGradients, ItsResidualIsTheTrueOneAfterAnyNumberOfIterations) {
  std::mt19937 generator(4);
  const Spectral S(random_spectrum(25, 0, generator), generator);
  const Spectral M(random_spectrum(25, 0, generator), generator);
  const Eigen::MatrixXd b = random_matrix(25, 1, generator);
  const double start = norms(M.inverse(), b)(0);
  for (int k = 0; k <= 12; ++k) {
    Eigen::MatrixXd X = b;
    KrylovOptions options = with(1e-14);
    options.most_iterations = k;
    const KrylovSummary summary = solve(S.matrix(), preconditioner_of(M.inverse()), X, options);
    EXPECT_FALSE(summary.converged);
    EXPECT_EQ(summary.most_iterations, k);
    EXPECT_NEAR(summary.residual, norms(M.inverse(), b - S.matrix() * X)(0) / start, 1e-13) << k;
    EXPECT_EQ(summary.history.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(summary.history.back(), summary.residual);
  }
}

TEST(ConjugateGradients, TheErrorInTheEnergyNormFallsInEveryIteration) {
  std::mt19937 generator(5);
  Eigen::VectorXd eigenvalues(40);
  for (int i = 0; i < 40; ++i) eigenvalues(i) = std::pow(10, -i / 13.0);
  const Spectral S(eigenvalues, generator);
  const Eigen::MatrixXd b = random_matrix(40, 1, generator);
  const Eigen::VectorXd exact = S.inverse() * b;
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 30; ++k) {
    Eigen::MatrixXd X = b;
    KrylovOptions options = with(1e-14);
    options.most_iterations = k;
    solve(S.matrix(), no_preconditioner(), X, options);
    const double error = norms(S.matrix(), X - exact)(0);
    EXPECT_LT(error, before) << k;
    before = error;
  }
}

TEST(ConjugateGradients, AZeroRightHandSideTakesNoIterations) {
  std::mt19937 generator(6);
  const Eigen::MatrixXd S = Spectral(random_spectrum(10, 0, generator), generator).matrix();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(10, 3);
  const KrylovSummary summary = solve(S, no_preconditioner(), X, with(1e-10));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 0);
  EXPECT_EQ(summary.residual, 0);
  EXPECT_TRUE(X.isZero(0));
}

TEST(ConjugateGradients, LanesAndThreadsAndNeighboursChangeNothing) {
  expect_neighbours_change_nothing(
      [](const Eigen::MatrixXd& matrix, const Preconditioner& M, Eigen::MatrixXd& X,
         const KrylovOptions& options) { return solve(matrix, M, X, options); },
      0);
}

TEST(ConjugateGradients, AnIndefiniteMatrixOrPreconditionerIsABreakdown) {
  std::mt19937 generator(8);
  const Eigen::MatrixXd S = Spectral(random_spectrum(10, 0, generator), generator).matrix();
  const Eigen::MatrixXd indefinite =
      Spectral(random_spectrum(10, 5, generator), generator).matrix();
  for (const int lanes : {1, most_lanes}) {
    Eigen::MatrixXd X = random_matrix(10, 20, generator);
    EXPECT_THROW(solve(indefinite, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
    X.setOnes();
    EXPECT_THROW(solve(S, preconditioner_of(indefinite), X, with(1e-10, lanes)), Breakdown);
    X.setOnes();
    EXPECT_THROW(solve(Eigen::MatrixXd::Zero(10, 10), no_preconditioner(), X, with(1e-10, lanes)),
                 Breakdown);
  }
}

TEST(ConjugateGradients, WhatIsNotFiniteIsABreakdown) {
  std::mt19937 generator(9);
  const Eigen::MatrixXd S = Spectral(random_spectrum(10, 0, generator), generator).matrix();
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const int lanes : {1, most_lanes}) {
      Eigen::MatrixXd X = random_matrix(10, 3, generator), bad = S;
      bad(2, 2) = poison;
      EXPECT_THROW(solve(bad, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
      X.setOnes();
      EXPECT_THROW(solve(S, preconditioner_of(bad), X, with(1e-10, lanes)), Breakdown);
      X.setOnes();
      X(4, 2) = poison;
      EXPECT_THROW(solve(S, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
    }
}

TEST(ConjugateGradients, OutOfTimeTellsHowFarItGot) {
  std::mt19937 generator(10);
  const Eigen::MatrixXd S = Spectral(random_spectrum(40, 0, generator), generator).matrix();
  for (const int threads : {1, 2}) {
    Eigen::MatrixXd X = random_matrix(40, 60, generator);
    try {
      solve(S, no_preconditioner(), X, with(1e-10, most_lanes, threads), Deadline::after(-1));
      FAIL() << "it went on";
    } catch (const TimeoutReached& timeout) {
      EXPECT_GE(timeout.done_fraction.value(), 0);
      EXPECT_LT(timeout.done_fraction.value(), 0.1);
      EXPECT_GT(timeout.error_so_far.value(), 1e-10);
      EXPECT_LE(timeout.error_so_far.value(), 1);
      EXPECT_NE(std::string(timeout.what()).find("conjugate gradients"), std::string::npos);
    }
  }
}

TEST(ConjugateGradients, TheDoneFractionCountsFinishedRightHandSidesAndDigits) {
  // Zero right-hand sides are done at once, the others are not: S is far from the identity.
  const int n = 100;
  const Eigen::MatrixXd S = Eigen::VectorXd::LinSpaced(n, 1e-6, 1).asDiagonal();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n, 10);
  X.rightCols(2).setOnes();
  try {
    solve(S, no_preconditioner(), X, with(1e-12), Deadline::after(-1));
    FAIL() << "it went on";
  } catch (const TimeoutReached& timeout) {
    EXPECT_LT(timeout.done_fraction.value(), 0.2);
  }
  X.setZero();
  X.rightCols(2).setOnes();
  try {
    solve(S, no_preconditioner(), X, with(1e-12, most_lanes), Deadline::after(-1));
    FAIL() << "it went on";
  } catch (const TimeoutReached& timeout) {
    EXPECT_GE(timeout.done_fraction.value(), 0.8);
    EXPECT_LT(timeout.done_fraction.value(), 1);
  }
}

TEST(RightHandSidesInParallel, OneTimeoutSumsUpAllRangesAndAnyOtherFailureWins) {
  try {
    in_parallel(2, 10, [](int begin, int) {
      if (begin > 0) throw TimeoutReached("second half", 0.4, 0.01);
    });
    FAIL() << "the failure was lost";
  } catch (const TimeoutReached& timeout) {
    EXPECT_DOUBLE_EQ(timeout.done_fraction.value(), 0.7);
    EXPECT_EQ(timeout.error_so_far, 0.01);
  }
  for (const int broken : {0, 5})
    EXPECT_THROW(in_parallel(2, 10,
                             [&](int begin, int) {
                               if (begin == broken) throw Breakdown("x");
                               throw TimeoutReached("y");
                             }),
                 Breakdown);
}

// Threads of BLAS and ours are not multiplied: beside ours BLAS has one each.
TEST(RightHandSidesInParallel, LeaveBlasOneThreadEach) {
  const int before = blas_threads();
  set_blas_threads(2);
  const int most = blas_threads();  // 1: this BLAS has no more
  std::array<int, 2> seen = {};
  in_parallel(2, 2, [&](int begin, int) { seen[begin] = blas_threads(); });
  EXPECT_EQ(seen, (std::array<int, 2>{1, 1}));
  EXPECT_EQ(blas_threads(), most);
  set_blas_threads(before);
}

}  // namespace
}  // namespace airybench::conjugate_gradients_test
