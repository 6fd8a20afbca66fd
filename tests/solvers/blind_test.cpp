#include "solvers/condensation/blind.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/scene.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

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

Eigen::MatrixXd whole(const Eigen::SparseMatrix<double>& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

constexpr BlindNumbering numberings[] = {BlindNumbering::multipliers_last,
                                         BlindNumbering::multipliers_after_unknowns};

TEST(Blind, IsTheWholeSystemInEitherNumbering) {
  for (const double friction : {0.2, 0.0}) {
    const DualSystem system = system_of(friction);
    const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + n_f + n_c, n + n_f + n_c);
    M.topLeftCorner(n, n) = whole(system.S);
    M.block(n, 0, n_f, n) = system.C_F;
    M.block(n + n_f, 0, n_c, n) = system.C_C;
    M.topRightCorner(n, n_f + n_c) = M.bottomLeftCorner(n_f + n_c, n).transpose();
    for (const BlindNumbering numbering : numberings) {
      const BlindSystem blind = make_blind_system(system, numbering);
      const Eigen::MatrixXd renumbered = whole(blind.lower);
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

TEST(Blind, ConstraintsThatDependOnEachOtherAreNotASuccess) {
  for (const char* method : {"BLIND", "BLIND:SCHUR", "BLIND:SKY"}) {
    DualSystem system = system_of();
    SparseRows doubled = system.C_F;
    doubled.row(1) = doubled.row(0);
    system.C_F = doubled;
    const Solution solution = run(select_methods(method).front(), system, {});
    EXPECT_EQ(solution.status, Status::breakdown) << method << ": " << solution.message;
  }
}

TEST(Blind, NotFiniteInputIsABreakdown) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const char* method : {"BLIND", "BLIND:SCHUR", "BLIND:SKY"}) {
      DualSystem system = system_of();
      system.S.valuePtr()[5] = poison;
      EXPECT_EQ(run(select_methods(method).front(), system, {}).status, Status::breakdown)
          << method;
      system = system_of();
      system.q = Eigen::VectorXd::Constant(system.n(), poison);
      EXPECT_NE(run(select_methods(method).front(), system, {}).status, Status::ok) << method;
    }
  }
}

TEST(Blind, AWrongNumberOfNegativePivotsIsABreakdown) {
  EXPECT_NO_THROW(check_inertia(3, 3));
  EXPECT_THROW(check_inertia(4, 3), Breakdown);
  for (const char* method : {"BLIND", "BLIND:SCHUR", "BLIND:SKY"}) {
    DualSystem system = system_of();
    system.S.coeffRef(10, 10) = -1;  // not positive definite any more
    const Solution solution = run(select_methods(method).front(), system, {});
    EXPECT_EQ(solution.status, Status::breakdown) << method;
    EXPECT_NE(solution.message.find("negative pivots instead of"), std::string::npos)
        << solution.message;
  }
}

}  // namespace
}  // namespace airybench::blind_test
