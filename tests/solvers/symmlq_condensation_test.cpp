#include "solvers/condensation/symmlq_condensation.hpp"

#include <gtest/gtest.h>

#include "solvers/krylov/symmlq.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/posed.hpp"

namespace airybench::symmlq_condensation_test {
namespace {

using namespace testing;

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
  Eigen::MatrixXd dense() const { return saddle_matrix(system); }
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
}  // namespace airybench::symmlq_condensation_test
