// The whole system [S Cᵀ; C 0]: as BLIND factorises it, and as SYMMLQ iterates it.
#include <gtest/gtest.h>

#include "solvers/condensation/blind.hpp"
#include "solvers/condensation/symmlq_condensation.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::saddle_test {
namespace {

using namespace testing;

// With all parts of the load.
AirySystem loaded_system(double friction = 0.2) {
  Scene scene;
  scene.friction = friction;
  scene.body_force_N_per_mm3 = {3, -1};
  return system_of(scene);
}

TEST(Blind, IsTheWholeSystemInEitherNumbering) {
  for (const double friction : {0.2, 0.0}) {
    const AirySystem system = loaded_system(friction);
    const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
    const Eigen::MatrixXd M = saddle_matrix(system);
    for (const auto numbering :
         {BlindNumbering::multipliers_last, BlindNumbering::multipliers_after_unknowns}) {
      const BlindSystem blind = make_blind_system(system, numbering);
      const Eigen::MatrixXd renumbered =
          Eigen::MatrixXd(blind.lower).selfadjointView<Eigen::Lower>();
      ASSERT_EQ(renumbered.rows(), M.rows());
      for (int i = 0; i < M.rows(); ++i)
        for (int j = 0; j < M.cols(); ++j)
          ASSERT_EQ(renumbered(blind.position[i], blind.position[j]), M(i, j));
      for (int i = 0; i < n; ++i) EXPECT_EQ(blind.load(blind.position[i]), system.q(i));
      for (int i = 0; i < n_f; ++i) EXPECT_EQ(blind.load(blind.position[n + i]), system.F(i));
      for (int i = 0; i < n_c; ++i)
        EXPECT_EQ(blind.load(blind.position[n + n_f + i]), -system.F0(i));
    }
  }
}

TEST(Blind, EveryMultiplierComesAfterItsUnknownsInThePanelsToo) {
  for (const double friction : {0.2, 0.0}) {
    const AirySystem system = loaded_system(friction);
    const BlindSystem blind = make_blind_system(system, BlindNumbering::multipliers_after_unknowns);
    EXPECT_TRUE(std::is_sorted(blind.position.begin(), blind.position.begin() + system.n()));
    for (const int panel_rows : {1, 3, 48, 64}) {
      const SkylineProfile profile = analyse_skyline(blind.lower, panel_rows);
      const SkylineFactor factor = factor_ldlt(profile, blind.lower);
      for (int k = 0; k < system.n_f() + system.n_c(); ++k) {
        const int multiplier = blind.position[system.n() + k];
        int last = 0;
        for (auto entry = constraint_row(system, k); entry; ++entry) {
          const int unknown = blind.position[entry.col()];
          last = std::max(last, unknown);
          EXPECT_LT(profile.position[unknown], profile.position[multiplier]);
        }
        // Between its last unknown and itself are multipliers only.
        for (int i = 0; i < system.n(); ++i)
          EXPECT_FALSE(blind.position[i] > last && blind.position[i] < multiplier);
        EXPECT_LT(factor.diagonal(profile.position[multiplier]), 0);
      }
      for (int i = 0; i < system.n(); ++i)
        EXPECT_GT(factor.diagonal(profile.position[blind.position[i]]), 0);
    }
  }
}

TEST(Blind, ASystemThatCannotBeSolvedIsABreakdown) {
  EXPECT_NO_THROW(check_inertia(3, 3));
  EXPECT_THROW(check_inertia(4, 3), Breakdown);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const char* method : {"BLIND", "BLIND:SCHUR", "BLIND:SKY"}) {
    SCOPED_TRACE(method);
    const auto solution_of = [&](auto spoil) {
      AirySystem system = loaded_system();
      spoil(system);
      return solved_by(method, system);
    };
    const Solution dependent = solution_of([](AirySystem& system) {
      SparseRows doubled = system.C_F;
      doubled.row(1) = doubled.row(0);
      system.C_F = doubled;
    });
    EXPECT_EQ(dependent.status, Status::breakdown) << dependent.message;
    const Solution indefinite = solution_of([](AirySystem& s) { s.S.coeffRef(10, 10) = -1; });
    EXPECT_EQ(indefinite.status, Status::breakdown);
    EXPECT_NE(indefinite.message.find("negative pivots instead of"), std::string::npos)
        << indefinite.message;
    for (const double poison : {std::nan(""), infinity}) {
      EXPECT_EQ(solution_of([&](AirySystem& s) { s.S.valuePtr()[5] = poison; }).status,
                Status::breakdown);
      EXPECT_NE(solution_of([&](AirySystem& s) {
                  s.q = Eigen::VectorXd::Constant(s.n(), poison);
                }).status,
                Status::ok);
    }
  }
}

TEST(SaddleOperator, IsTheWholeMatrix) {
  const AirySystem system = loaded_system();
  const SymmetricOperator A = saddle_operator(system);
  std::mt19937 generator(12);
  for (const int lanes : {1, max_lanes}) {
    const LaneBlock X = random_matrix(A.n, lanes, generator);
    LaneBlock Y(A.n, lanes);
    A.multiply(X, Y);
    EXPECT_LT(distance(Y, saddle_matrix(system) * X), 1e-14 * Y.norm() * std::sqrt(A.n));
  }
}

TEST(SaddlePreconditioner, BlocksAreTheInversesOfTheirDefinition) {
  const AirySystem system = loaded_system();
  const int n = system.n(), m = system.n_f() + system.n_c();
  const Eigen::MatrixXd A = saddle_matrix(system);
  const Eigen::MatrixXd C = A.bottomLeftCorner(m, n);
  const Preconditioner S_star = preconditioner_named("DTIC3")(system.S, {});
  LaneBlock S_star_C(n, 1);
  const Apply apply_S = S_star.applier(1);
  Eigen::MatrixXd X(n, m);
  for (int k = 0; k < m; ++k) {
    S_star_C = C.row(k).transpose();
    apply_S(S_star_C);
    X.col(k) = S_star_C;
  }
  const Eigen::MatrixXd block = C * X;
  for (const int threads : {1, 2})
    for (const int lanes : {1, max_lanes}) {
      const Preconditioner M = saddle_preconditioner(system, S_star, threads);
      std::mt19937 generator(13);
      const LaneBlock B = random_matrix(n + m, lanes, generator);
      LaneBlock Y = B, top = B.topRows(n);
      M.applier(lanes)(Y);
      S_star.applier(lanes)(top);
      EXPECT_LT(distance(Y.topRows(n), top), 1e-14 * top.norm());
      const Eigen::MatrixXd bottom = B.bottomRows(m);
      EXPECT_LT(residual(block, Y.bottomRows(m), bottom), 1e-10 * bottom.norm());
      EXPECT_GE(M.bytes, S_star.bytes);
    }
}

TEST(SaddlePreconditioner, ExactBlocksLeaveThreeEigenvaluesAndThreeIterations) {
  const AirySystem system = loaded_system();
  const Preconditioner exact = preconditioner_named("SKY")(system.S, {});
  const Preconditioner M = saddle_preconditioner(system, exact, 1);
  std::mt19937 generator(14);
  const Eigen::MatrixXd B = random_matrix(system.n() + system.n_f() + system.n_c(), 20, generator);
  Eigen::MatrixXd X = B;
  const KrylovSummary summary =
      solve_by_symmlq(saddle_operator(system), M, columns_of(X), with(1e-8, max_lanes));
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.max_iterations, 3);
  EXPECT_LT(residual(saddle_matrix(system), X, B), 1e-6 * B.norm());
}

}  // namespace
}  // namespace airybench::saddle_test
