#include "solvers/condensation/blind.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/scene.hpp"
#include "solvers/direct/skyline.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::blind_test {
namespace {

DualSystem system_of(double friction = 0.2) {
  Scene scene;
  scene.friction = friction;
  scene.body_force_N_per_mm3 = {3, -1};  // all parts of the load
  return testing::system_of(scene);
}

// Unknowns of φ in row k of [C_F; C_C].
std::vector<int> unknowns_of(const DualSystem& system, int k) {
  const SparseRows& C = k < system.n_f() ? system.C_F : system.C_C;
  std::vector<int> columns;
  for (SparseRows::InnerIterator entry(C, k < system.n_f() ? k : k - system.n_f()); entry; ++entry)
    columns.push_back(static_cast<int>(entry.col()));
  return columns;
}

TEST(Blind, IsTheWholeSystemInEitherNumbering) {
  for (const double friction : {0.2, 0.0}) {
    const DualSystem system = system_of(friction);
    const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
    const Eigen::MatrixXd M = testing::saddle_matrix(system);
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
    const DualSystem system = system_of(friction);
    const BlindSystem blind = make_blind_system(system, BlindNumbering::multipliers_after_unknowns);
    EXPECT_TRUE(std::is_sorted(blind.position.begin(), blind.position.begin() + system.n()));
    for (const int panel_rows : {1, 3, 48, 64}) {
      const SkylineProfile profile = analyse_skyline(blind.lower, panel_rows);
      const SkylineFactor factor = factor_ldlt(profile, blind.lower);
      for (int k = 0; k < system.n_f() + system.n_c(); ++k) {
        const int multiplier = blind.position[system.n() + k];
        int last = 0;
        for (const int unknown : unknowns_of(system, k)) {
          last = std::max(last, blind.position[unknown]);
          EXPECT_LT(profile.position[blind.position[unknown]], profile.position[multiplier]);
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
    const auto solved = [&](auto spoil) {
      DualSystem system = system_of();
      spoil(system);
      return testing::solved_by(method, system);
    };
    const Solution dependent = solved([](DualSystem& system) {
      SparseRows doubled = system.C_F;
      doubled.row(1) = doubled.row(0);
      system.C_F = doubled;
    });
    EXPECT_EQ(dependent.status, Status::breakdown) << dependent.message;
    const Solution indefinite = solved([](DualSystem& s) { s.S.coeffRef(10, 10) = -1; });
    EXPECT_EQ(indefinite.status, Status::breakdown);
    EXPECT_NE(indefinite.message.find("negative pivots instead of"), std::string::npos)
        << indefinite.message;
    for (const double poison : {std::nan(""), infinity}) {
      EXPECT_EQ(solved([&](DualSystem& s) { s.S.valuePtr()[5] = poison; }).status,
                Status::breakdown);
      EXPECT_NE(
          solved([&](DualSystem& s) { s.q = Eigen::VectorXd::Constant(s.n(), poison); }).status,
          Status::ok);
    }
  }
}

}  // namespace
}  // namespace airybench::blind_test
