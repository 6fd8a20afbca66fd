// SYMMLQ and conjugate gradients: what holds for both, then what holds for one.
#include "solvers/krylov/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "solvers/base/blas_library.hpp"
#include "solvers/krylov/symmlq.hpp"
#include "tests/support/dense_operators.hpp"

namespace airybench::krylov_test {
namespace {

using namespace testing;

// X ← A⁻¹ X.
KrylovSummary symmlq(const Eigen::MatrixXd& A, const Preconditioner& M, Eigen::MatrixXd& X,
                     const KrylovOptions& options, const Deadline& deadline = {}) {
  return solve_by_symmlq(operator_of(A), M, columns_of(X), options, deadline);
}

KrylovSummary conjugate_gradients(const Eigen::MatrixXd& A, const Preconditioner& M,
                                  Eigen::MatrixXd& X, const KrylovOptions& options,
                                  const Deadline& deadline = {}) {
  return solve_by_conjugate_gradients(lower_of(A), M, columns_of(X), options, deadline);
}

struct KrylovMethod {
  const char* name;
  decltype(&symmlq) solve;
  bool indefinite;       // solves such systems
  double least, follow;  // smallest tolerance; its residual follows the true one to this
};
std::ostream& operator<<(std::ostream& out, const KrylovMethod& method) {
  return out << method.name;
}

class Krylov : public ::testing::TestWithParam<KrylovMethod> {
 protected:
  std::mt19937 generator{1};
  // With negative eigenvalues where the method allows them.
  Spectral random_spectral(int n) {
    return Spectral(random_spectrum(n, GetParam().indefinite ? n * 4 / 9 : 0, generator),
                    generator);
  }
  KrylovSummary solve(const Eigen::MatrixXd& A, const Preconditioner& M, Eigen::MatrixXd& X,
                      const KrylovOptions& options, const Deadline& deadline = {}) const {
    return GetParam().solve(A, M, X, options, deadline);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Krylov,
                         ::testing::Values(KrylovMethod{"SYMMLQ", symmlq, true, 1e-13, 1e-12},
                                           KrylovMethod{"conjugate gradients", conjugate_gradients,
                                                        false, 1e-14, 1e-13}),
                         [](const auto& method) {
                           return std::string(method.param.indefinite ? "Symmlq" : "Cg");
                         });

TEST_P(Krylov, SolvesWithAndWithoutAPreconditioner) {
  for (const int n : {1, 2, 3, 7, 40})
    for (const int negative : {0, n / 2, n})
      for (const int lanes : {1, max_lanes}) {
        if (negative > 0 && !GetParam().indefinite) continue;
        const Spectral A(random_spectrum(n, negative, generator), generator);
        const Spectral M(random_spectrum(n, 0, generator), generator);
        const Eigen::MatrixXd B = random_matrix(n, 5, generator);
        for (const Preconditioner& preconditioner :
             {no_preconditioner(), preconditioner_of(M.inverse())}) {
          Eigen::MatrixXd X = B;
          EXPECT_TRUE(solve(A.matrix(), preconditioner, X, with(GetParam().least, lanes)).converged)
              << n;
          EXPECT_LT(testing::distance(X, A.inverse() * B), 100 * GetParam().least * X.norm())
              << n << ", " << negative << " negative, " << lanes << " lanes";
        }
      }
}

TEST_P(Krylov, EndsAfterAsManyIterationsAsThereAreDifferentEigenvalues) {
  const double minus = GetParam().indefinite ? -1 : 1;
  const std::vector<double> all = {3, minus, 0.5, 2 * minus, 1.5, 4};
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

TEST_P(Krylov, ItsResidualIsTheTrueOneAfterAnyNumberOfIterations) {
  const Spectral A = random_spectral(25);
  const Spectral M(random_spectrum(25, 0, generator), generator);
  const Eigen::MatrixXd b = random_matrix(25, 1, generator);
  const double start = norms(M.inverse(), b)(0);
  for (int k = 0; k <= (GetParam().indefinite ? 20 : 12); ++k) {
    Eigen::MatrixXd X = b;
    KrylovOptions options = with(1e-14);
    options.max_iterations = k;
    const KrylovSummary summary = solve(A.matrix(), preconditioner_of(M.inverse()), X, options);
    EXPECT_FALSE(summary.converged);
    EXPECT_EQ(summary.max_iterations, k);
    EXPECT_NEAR(summary.residual, norms(M.inverse(), b - A.matrix() * X)(0) / start,
                GetParam().follow)
        << k;
    EXPECT_EQ(summary.history.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(summary.history.back(), summary.residual);
  }
}

// The matrix itself where it is definite.
TEST_P(Krylov, TheAbsoluteValueOfTheMatrixIsPreconditionerForAnIterationPerSign) {
  const Spectral A(1e4 * random_spectral(30).eigenvalues, generator);
  const Eigen::MatrixXd B = random_matrix(30, 4, generator);
  Eigen::MatrixXd X = B;
  const KrylovSummary summary =
      solve(A.matrix(), preconditioner_of(A.absolute_inverse()), X, with(1e-10));
  EXPECT_EQ(summary.max_iterations, GetParam().indefinite ? 2 : 1);
  EXPECT_EQ(summary.iterations, 4 * summary.max_iterations);
  EXPECT_LT(testing::distance(X, A.inverse() * B), 1e-9 * X.norm());
}

TEST_P(Krylov, NoRightHandSidesAndZeroOnesTakeNoIterations) {
  for (const int columns : {0, 3})
    for (const int threads : {1, 2}) {
      Eigen::MatrixXd X = Eigen::MatrixXd::Zero(10, columns);
      const KrylovSummary summary =
          solve(random_spectral(10).matrix(), no_preconditioner(), X, with(1e-10, 1, threads));
      EXPECT_TRUE(summary.converged);
      EXPECT_EQ(summary.iterations, 0);
      EXPECT_EQ(summary.residual, 0);
      EXPECT_TRUE(X.isZero(0));
    }
}

// On right-hand sides that take from none to many iterations.
TEST_P(Krylov, LanesAndThreadsAndNeighboursChangeNothing) {
  // Large enough to converge long before rounding decides when.
  const int n = 150, count = 53;
  const Spectral spectral = random_spectral(n);
  const Eigen::MatrixXd A = spectral.matrix();
  const Spectral M(random_spectrum(n, 0, generator).cwiseSqrt().cwiseSqrt(), generator);
  Eigen::MatrixXd B = random_matrix(n, count, generator);
  for (int k = 0; k < count; k += 7)  // 1 to 5 iterations without M
    B.col(k) = 1e3 * spectral.Q.leftCols(1 + k % 5).rowwise().sum();
  B.col(20).setZero();
  for (const Preconditioner& preconditioner :
       {no_preconditioner(), preconditioner_of(M.inverse())}) {
    Eigen::MatrixXd alone = B;
    KrylovSummary sum;
    for (Eigen::Index k = 0; k < count; ++k) {
      Eigen::MatrixXd X = B.col(k);
      const KrylovSummary one = solve(A, preconditioner, X, with(1e-7));
      alone.col(k) = X;
      sum.iterations += one.iterations;
      sum.max_iterations = std::max(sum.max_iterations, one.max_iterations);
      if (k == 0) sum.history = one.history;
    }
    EXPECT_LT(sum.max_iterations, n);
    for (const int lanes : {1, max_lanes})
      for (const int threads : {1, 2, 5}) {
        SCOPED_TRACE(::testing::Message() << lanes << " lanes, " << threads << " threads");
        Eigen::MatrixXd X = B;
        const KrylovSummary summary = solve(A, preconditioner, X, with(1e-7, lanes, threads));
        EXPECT_TRUE(summary.converged);
        EXPECT_EQ(summary.iterations, sum.iterations);
        EXPECT_EQ(summary.max_iterations, sum.max_iterations);
        EXPECT_EQ(summary.history.size(), sum.history.size());
        EXPECT_LT((X - alone).norm(), 1e-11 * alone.norm());
      }
  }
}

TEST_P(Krylov, APreconditionerThatIsNotPositiveDefiniteIsABreakdown) {
  const Eigen::MatrixXd A = random_spectral(10).matrix();
  Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(10);
  diagonal(3) = -20;
  for (const Eigen::MatrixXd& inverse :
       {Eigen::MatrixXd(-Eigen::MatrixXd::Identity(10, 10)), Eigen::MatrixXd(diagonal.asDiagonal()),
        Spectral(random_spectrum(10, 5, generator), generator).matrix()})
    for (const int lanes : {1, max_lanes}) {
      Eigen::MatrixXd X = random_matrix(10, 20, generator);
      EXPECT_THROW(solve(A, preconditioner_of(inverse), X, with(1e-10, lanes)), Breakdown);
    }
}

TEST_P(Krylov, WhatIsNotFiniteIsABreakdown) {
  const Eigen::MatrixXd A = random_spectral(10).matrix();
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const int lanes : {1, max_lanes}) {
      Eigen::MatrixXd X = random_matrix(10, 3, generator), bad = A;
      bad(2, 2) = poison;
      EXPECT_THROW(solve(bad, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
      X.setOnes();
      EXPECT_THROW(solve(A, preconditioner_of(bad), X, with(1e-10, lanes)), Breakdown);
      X.setOnes();
      X(4, 2) = poison;
      EXPECT_THROW(solve(A, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
    }
}

TEST_P(Krylov, OutOfTimeTellsHowFarItGot) {
  const Eigen::MatrixXd A = random_spectral(40).matrix();
  for (const int threads : {1, 2}) {
    Eigen::MatrixXd X = random_matrix(40, 60, generator);
    try {
      solve(A, no_preconditioner(), X, with(1e-10, max_lanes, threads), Deadline::after(-1));
      FAIL() << "it went on";
    } catch (const TimeoutReached& timeout) {
      EXPECT_GE(timeout.done_fraction.value(), 0);
      EXPECT_LT(timeout.done_fraction.value(), 0.1);
      EXPECT_GT(timeout.error_so_far.value(), 1e-10);
      EXPECT_LE(timeout.error_so_far.value(), 1);
      EXPECT_NE(std::string(timeout.what()).find(GetParam().name), std::string::npos);
    }
  }
}

TEST(Symmlq, FindsTheShortestSolutionOfASingularSystemThatHasSome) {
  std::mt19937 generator(4);
  for (const int zeros : {1, 3}) {
    Eigen::VectorXd eigenvalues = random_spectrum(20, 8, generator);
    eigenvalues.segment(5, zeros).setZero();
    const Spectral A(eigenvalues, generator);
    const Eigen::MatrixXd B = A.matrix() * random_matrix(20, 20, generator);
    for (const int lanes : {1, max_lanes}) {
      Eigen::MatrixXd X = B;
      EXPECT_TRUE(symmlq(A.matrix(), no_preconditioner(), X, with(1e-11, lanes)).converged);
      EXPECT_LT(testing::residual(A.matrix(), X, B), 1e-10 * B.norm());
      EXPECT_LT(testing::distance(X, A.inverse() * B), 1e-9 * X.norm());
    }
  }
}

TEST(Symmlq, SolvesWhereTheFirstTridiagonalMatrixIsSingular) {
  // bᵀA b = 0: the first Galerkin iterate does not exist.
  const Eigen::MatrixXd A = Eigen::Vector2d(1, -1).asDiagonal();
  Eigen::MatrixXd X = Eigen::Vector2d(1, 1);
  const KrylovSummary summary = symmlq(A, no_preconditioner(), X, with(1e-12));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 2);
  EXPECT_LT((X - Eigen::Vector2d(1, -1)).norm(), 1e-14);
}

TEST(Symmlq, ASystemWithoutASolutionIsNotASuccess) {
  const Eigen::MatrixXd A = Eigen::Vector3d(2, -1, 0).asDiagonal();
  for (const Eigen::Vector3d& b : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 1)}) {
    Eigen::MatrixXd X = b;
    try {
      EXPECT_FALSE(symmlq(A, no_preconditioner(), X, with(1e-10)).converged);
    } catch (const Breakdown&) {  // the other honest end
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
  for (const int lanes : {1, max_lanes}) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd X = B;
    solve_by_conjugate_gradients(lower, no_preconditioner(), columns_of(X), with(1e-14, lanes));
    EXPECT_LT(testing::residual(S, X, B), 1e-12);
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
    options.max_iterations = k;
    conjugate_gradients(S.matrix(), no_preconditioner(), X, options);
    const double error = norms(S.matrix(), X - exact)(0);
    EXPECT_LT(error, before) << k;
    before = error;
  }
}

TEST(ConjugateGradients, AMatrixThatIsNotPositiveDefiniteIsABreakdown) {
  std::mt19937 generator(8);
  for (const Eigen::MatrixXd& S : {Spectral(random_spectrum(10, 5, generator), generator).matrix(),
                                   Eigen::MatrixXd(Eigen::MatrixXd::Zero(10, 10))})
    for (const int lanes : {1, max_lanes}) {
      Eigen::MatrixXd X = random_matrix(10, 20, generator);
      EXPECT_THROW(conjugate_gradients(S, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
    }
}

TEST(ConjugateGradients, TheDoneFractionCountsFinishedRightHandSidesAndDigits) {
  // Zero right-hand sides are done at once, the others are not: S is far from the identity.
  const int n = 100;
  const Eigen::MatrixXd S = Eigen::VectorXd::LinSpaced(n, 1e-6, 1).asDiagonal();
  for (const auto& [lanes, least, most] : {std::tuple(1, 0.0, 0.2), {max_lanes, 0.8, 1.0}}) {
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n, 10);
    X.rightCols(2).setOnes();
    try {
      conjugate_gradients(S, no_preconditioner(), X, with(1e-12, lanes), Deadline::after(-1));
      FAIL() << "it went on";
    } catch (const TimeoutReached& timeout) {
      EXPECT_GE(timeout.done_fraction.value(), least);
      EXPECT_LT(timeout.done_fraction.value(), most);
    }
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

// Threads of BLAS and ours are not multiplied: next to ours BLAS has one each.
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
}  // namespace airybench::krylov_test
