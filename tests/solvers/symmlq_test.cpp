#include "solvers/krylov/symmlq.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "assembly/scene.hpp"
#include "solvers/condensation/symmlq_condensation.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/krylov_checks.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::symmlq_test {
namespace {

using namespace testing;

// X ← A⁻¹ X.
KrylovSummary solve(const Eigen::MatrixXd& A, const Preconditioner& M, Eigen::MatrixXd& X,
                    const KrylovOptions& options, const Deadline& deadline = {}) {
  return solve_by_symmlq(operator_of(A), M, columns_of(X), options, deadline);
}

TEST(Symmlq, SolvesIndefiniteSystemsWithAndWithoutAPreconditioner) {
  std::mt19937 generator(1);
  for (const int n : {1, 2, 3, 7, 40})
    for (const int negative : {0, n / 2, n})
      for (const int lanes : {1, most_lanes}) {
        const Spectral A(random_spectrum(n, negative, generator), generator);
        const Spectral M(random_spectrum(n, 0, generator), generator);
        const Eigen::MatrixXd B = random_matrix(n, 5, generator);
        for (const Preconditioner& preconditioner :
             {no_preconditioner(), preconditioner_of(M.inverse())}) {
          Eigen::MatrixXd X = B;
          const KrylovSummary summary = solve(A.matrix(), preconditioner, X, with(1e-13, lanes));
          EXPECT_TRUE(summary.converged) << n;
          EXPECT_LT(testing::distance(X, A.inverse() * B), 1e-11 * X.norm())
              << n << ", " << negative << " negative, " << lanes << " lanes";
        }
      }
}

TEST(Symmlq, EndsAfterAsManyIterationsAsThereAreDifferentEigenvalues) {
  std::mt19937 generator(2);
  const std::vector<double> all = {3, -1, 0.5, -2, 1.5, 4};
  for (std::size_t different = 1; different <= all.size(); ++different) {
    Eigen::VectorXd eigenvalues(30);
    for (int i = 0; i < 30; ++i) eigenvalues(i) = all[i % different];
    const Eigen::MatrixXd A = Spectral(eigenvalues, generator).matrix();
    Eigen::MatrixXd X = random_matrix(30, 1, generator);
    const KrylovSummary summary = solve(A, no_preconditioner(), X, with(1e-9));
    EXPECT_TRUE(summary.converged);
    EXPECT_EQ(summary.iterations, static_cast<std::int64_t>(different));
  }
}

TEST(Symmlq, ItsResidualIsTheTrueOneAfterAnyNumberOfIterations) {
  std::mt19937 generator(3);
  const Spectral A(random_spectrum(25, 11, generator), generator);
  const Spectral M(random_spectrum(25, 0, generator), generator);
  const Eigen::MatrixXd b = random_matrix(25, 1, generator);
  const double start = norms(M.inverse(), b)(0);
  for (int k = 0; k <= 20; ++k) {
    Eigen::MatrixXd X = b;
    KrylovOptions options = with(1e-14);
    options.most_iterations = k;
    const KrylovSummary summary = solve(A.matrix(), preconditioner_of(M.inverse()), X, options);
    EXPECT_FALSE(summary.converged);
    EXPECT_EQ(summary.most_iterations, k);
    EXPECT_NEAR(summary.residual, norms(M.inverse(), b - A.matrix() * X)(0) / start, 1e-12) << k;
    EXPECT_EQ(summary.history.size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(summary.history.back(), summary.residual);
  }
}

TEST(Symmlq, FindsTheShortestSolutionOfASingularSystemThatHasSome) {
  std::mt19937 generator(4);
  for (const int zeros : {1, 3}) {
    Eigen::VectorXd eigenvalues = random_spectrum(20, 8, generator);
    eigenvalues.segment(5, zeros).setZero();
    const Spectral A(eigenvalues, generator);
    const Eigen::MatrixXd B = A.matrix() * random_matrix(20, 20, generator);
    for (const int lanes : {1, most_lanes}) {
      Eigen::MatrixXd X = B;
      EXPECT_TRUE(solve(A.matrix(), no_preconditioner(), X, with(1e-11, lanes)).converged);
      EXPECT_LT(testing::residual(A.matrix(), X, B), 1e-10 * B.norm());
      EXPECT_LT(testing::distance(X, A.inverse() * B), 1e-9 * X.norm());
    }
  }
}

TEST(Symmlq, SolvesWhereTheFirstTridiagonalMatrixIsSingular) {
  // bᵀA b = 0: the first Galerkin iterate does not exist.
  const Eigen::MatrixXd A = Eigen::Vector2d(1, -1).asDiagonal();
  Eigen::MatrixXd X = Eigen::Vector2d(1, 1);
  const KrylovSummary summary = solve(A, no_preconditioner(), X, with(1e-12));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 2);
  EXPECT_LT((X - Eigen::Vector2d(1, -1)).norm(), 1e-14);
}

TEST(Symmlq, ASystemWithoutASolutionIsNotASuccess) {
  const Eigen::MatrixXd A = Eigen::Vector3d(2, -1, 0).asDiagonal();
  for (const Eigen::Vector3d& b : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 1)}) {
    Eigen::MatrixXd X = b;
    try {
      EXPECT_FALSE(solve(A, no_preconditioner(), X, with(1e-10)).converged);
    } catch (const Breakdown&) {  // the other honest end
    }
  }
}

TEST(Symmlq, AZeroRightHandSideTakesNoIterations) {
  std::mt19937 generator(5);
  const Eigen::MatrixXd A = Spectral(random_spectrum(10, 4, generator), generator).matrix();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(10, 3);
  const KrylovSummary summary = solve(A, no_preconditioner(), X, with(1e-10));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 0);
  EXPECT_EQ(summary.residual, 0);
  EXPECT_TRUE(X.isZero(0));
}

TEST(Symmlq, NoRightHandSidesAreSolvedAtOnce) {
  Eigen::MatrixXd X(3, 0);
  for (const int threads : {1, 2}) {
    const KrylovSummary summary =
        solve(Eigen::MatrixXd::Identity(3, 3), no_preconditioner(), X, with(1e-10, 1, threads));
    EXPECT_TRUE(summary.converged);
    EXPECT_EQ(summary.iterations, 0);
  }
}

TEST(Symmlq, AnEigenvectorTakesOneIteration) {
  std::mt19937 generator(6);
  const Spectral A(random_spectrum(12, 5, generator), generator);
  Eigen::MatrixXd X = 1e8 * A.Q;
  const KrylovSummary summary = solve(A.matrix(), no_preconditioner(), X, with(1e-10, most_lanes));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.iterations, 12);
  EXPECT_EQ(summary.most_iterations, 1);
  EXPECT_LT(testing::distance(X, 1e8 * A.Q * A.eigenvalues.cwiseInverse().asDiagonal()), 1e-6);
}

TEST(Symmlq, LanesAndThreadsAndNeighboursChangeNothing) {
  expect_neighbours_change_nothing(
      [](const Eigen::MatrixXd& matrix, const Preconditioner& M, Eigen::MatrixXd& X,
         const KrylovOptions& options) { return solve(matrix, M, X, options); },
      70);
}

TEST(Symmlq, APreconditionerThatIsNotPositiveDefiniteIsABreakdown) {
  std::mt19937 generator(8);
  const Eigen::MatrixXd A = Spectral(random_spectrum(10, 4, generator), generator).matrix();
  Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(10);
  diagonal(3) = -20;
  for (const Eigen::MatrixXd& inverse : {Eigen::MatrixXd(-Eigen::MatrixXd::Identity(10, 10)),
                                         Eigen::MatrixXd(diagonal.asDiagonal())}) {
    Eigen::MatrixXd X = random_matrix(10, 20, generator);
    EXPECT_THROW(solve(A, preconditioner_of(inverse), X, with(1e-10, most_lanes)), Breakdown);
  }
}

TEST(Symmlq, WhatIsNotFiniteIsABreakdown) {
  std::mt19937 generator(9);
  const Eigen::MatrixXd A = Spectral(random_spectrum(10, 4, generator), generator).matrix();
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const int lanes : {1, most_lanes}) {
      Eigen::MatrixXd X = random_matrix(10, 3, generator), bad = A;
      bad(2, 2) = poison;
      EXPECT_THROW(solve(bad, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
      X.setOnes();
      EXPECT_THROW(solve(A, preconditioner_of(bad), X, with(1e-10, lanes)), Breakdown);
      X(4, 2) = poison;
      EXPECT_THROW(solve(A, no_preconditioner(), X, with(1e-10, lanes)), Breakdown);
    }
}

TEST(Symmlq, OutOfTimeTellsHowFarItGot) {
  std::mt19937 generator(10);
  const Eigen::MatrixXd A = Spectral(random_spectrum(40, 20, generator), generator).matrix();
  for (const int threads : {1, 2}) {
    Eigen::MatrixXd X = random_matrix(40, 60, generator);
    try {
      solve(A, no_preconditioner(), X, with(1e-10, most_lanes, threads), Deadline::after(-1));
      FAIL() << "it went on";
    } catch (const TimeoutReached& timeout) {
      EXPECT_GE(timeout.done_fraction.value(), 0);
      EXPECT_LT(timeout.done_fraction.value(), 0.1);
      EXPECT_GT(timeout.error_so_far.value(), 1e-10);
      EXPECT_LE(timeout.error_so_far.value(), 1);
      EXPECT_NE(std::string(timeout.what()).find("SYMMLQ"), std::string::npos);
    }
  }
}

TEST(Symmlq, TheAbsoluteValueOfTheMatrixIsPreconditionerForTwoIterations) {
  std::mt19937 generator(11);
  const Spectral A(1e3 * random_spectrum(30, 14, generator), generator);
  const Eigen::MatrixXd B = random_matrix(30, 4, generator);
  Eigen::MatrixXd X = B;
  const KrylovSummary summary =
      solve(A.matrix(), preconditioner_of(A.absolute_inverse()), X, with(1e-10));
  EXPECT_EQ(summary.most_iterations, 2);
  EXPECT_LT(testing::distance(X, A.inverse() * B), 1e-9 * X.norm());
}

// The whole system, its load and unit contact forces.
struct Saddle {
  DualSystem system;
  int n, m;
  Saddle() {
    Scene scene;
    scene.body_force_N_per_mm3 = {3, -1};
    system = testing::system_of(scene);
    n = system.n(), m = system.n_f() + system.n_c();
  }
  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
    A.topLeftCorner(n, n) = Eigen::MatrixXd(system.S).selfadjointView<Eigen::Lower>();
    A.block(n, 0, system.n_f(), n) = system.C_F;
    A.block(n + system.n_f(), 0, system.n_c(), n) = system.C_C;
    A.topRightCorner(n, m) = A.bottomLeftCorner(m, n).transpose();
    return A;
  }
};

TEST(SaddleOperator, IsTheWholeMatrix) {
  const Saddle saddle;
  const SymmetricOperator A = saddle_operator(saddle.system);
  std::mt19937 generator(12);
  for (const int lanes : {1, most_lanes}) {
    const LaneBlock X = random_matrix(A.n, lanes, generator);
    LaneBlock Y(A.n, lanes);
    A.multiply(X, Y);
    EXPECT_LT(testing::distance(Y, saddle.dense() * X), 1e-14 * Y.norm() * std::sqrt(A.n));
  }
}

TEST(SaddlePreconditioner, BlocksAreTheInversesOfTheirDefinition) {
  const Saddle saddle;
  const Eigen::MatrixXd A = saddle.dense();
  const Eigen::MatrixXd C = A.bottomLeftCorner(saddle.m, saddle.n);
  const Preconditioner S_star = preconditioner_named("DTIC3")(saddle.system.S, {});
  LaneBlock S_star_C(saddle.n, 1);
  const Apply apply_S = S_star.applier(1);
  Eigen::MatrixXd X(saddle.n, saddle.m);
  for (int k = 0; k < saddle.m; ++k) {
    S_star_C = C.row(k).transpose();
    apply_S(S_star_C);
    X.col(k) = S_star_C;
  }
  for (const SchurBlock schur : {SchurBlock::dense, SchurBlock::sparse})
    for (const int build_lanes : {1, most_lanes})
      for (const int threads : {1, 2})
        for (const int lanes : {1, most_lanes}) {
          const Preconditioner M =
              saddle_preconditioner(saddle.system, S_star, schur, build_lanes, threads);
          const Eigen::MatrixXd block =
              schur == SchurBlock::dense ? C * X : Eigen::MatrixXd(C * C.transpose());
          std::mt19937 generator(13);
          const LaneBlock B = random_matrix(saddle.n + saddle.m, lanes, generator);
          LaneBlock Y = B, top = B.topRows(saddle.n);
          M.applier(lanes)(Y);
          S_star.applier(lanes)(top);
          EXPECT_LT(testing::distance(Y.topRows(saddle.n), top), 1e-14 * top.norm());
          const Eigen::MatrixXd bottom = B.bottomRows(saddle.m);
          EXPECT_LT(testing::residual(block, Y.bottomRows(saddle.m), bottom),
                    1e-10 * bottom.norm());
          EXPECT_GE(M.bytes, S_star.bytes);
        }
}

TEST(SaddlePreconditioner, ExactBlocksLeaveThreeEigenvaluesAndThreeIterations) {
  const Saddle saddle;
  const Preconditioner exact = preconditioner_named("SKY")(saddle.system.S, {});
  const Preconditioner M =
      saddle_preconditioner(saddle.system, exact, SchurBlock::dense, most_lanes, 1);
  std::mt19937 generator(14);
  const Eigen::MatrixXd B = random_matrix(saddle.n + saddle.m, 20, generator);
  Eigen::MatrixXd X = B;
  const KrylovSummary summary =
      solve_by_symmlq(saddle_operator(saddle.system), M, columns_of(X), with(1e-8, most_lanes));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.most_iterations, 3);
  EXPECT_LT(testing::residual(saddle.dense(), X, B), 1e-6 * B.norm());
}

}  // namespace
}  // namespace airybench::symmlq_test
