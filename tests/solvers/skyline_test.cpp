#include "solvers/direct/skyline.hpp"

#include <gtest/gtest.h>

#include <random>

#include "assembly/dual_system.hpp"
#include "assembly/scene.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::skyline_test {
namespace {

// A random symmetric positive definite matrix whose row i begins at column first(i).
template <typename First>
Eigen::MatrixXd random_skyline(int n, First first, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = first(i); j < i; ++j) A(i, j) = A(j, i) = uniform(generator);
  for (int i = 0; i < n; ++i) A(i, i) = 1 + A.row(i).cwiseAbs().sum();
  return A;
}

Eigen::SparseMatrix<double> lower(const Eigen::MatrixXd& A) {
  return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
}

double relative_residual(const Eigen::MatrixXd& A, const Eigen::MatrixXd& x,
                         const Eigen::MatrixXd& b) {
  return testing::residual(A, x, b) / (A.norm() * x.norm());
}

TEST(Skyline, SolvesEveryShapeOfProfileWithEveryPanelSize) {
  std::mt19937 generator(4);
  const auto dense = [](int) { return 0; };
  const auto diagonal = [](int i) { return i; };
  const auto band = [](int i) { return std::max(0, i - 5); };
  const auto alternating = [](int i) { return i % 3 == 0 ? std::max(0, i - 40) : i - i % 2; };
  const auto arrow = [](int i) { return i > 60 ? 0 : i; };
  const std::vector<std::function<int(int)>> shapes = {dense, diagonal, band, alternating, arrow};
  for (std::size_t shape = 0; shape < shapes.size(); ++shape) {
    for (const int n : {1, 2, 67, 130}) {
      const Eigen::MatrixXd A = random_skyline(n, shapes[shape], generator);
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, 7);
      for (const int panel_rows : {1, 3, 16, 48, 200}) {
        const SkylineFactor factor = factor_ldlt(analyse_skyline(lower(A), panel_rows), lower(A));
        Eigen::MatrixXd x = b;
        solve_in_place(factor, x);
        EXPECT_LT(relative_residual(A, x, b), 1e-15 * 10)
            << "shape " << shape << ", n " << n << ", panel rows " << panel_rows;
      }
    }
  }
}

TEST(Skyline, CountsTheClassicalProfile) {
  // Rows begin at columns 0, 0, 2, 1: heights 1, 2, 1, 3.
  Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(4, 4);
  A(1, 0) = A(0, 1) = A(3, 1) = A(1, 3) = 1;
  const SkylineProfile profile = analyse_skyline(lower(A), 2);
  EXPECT_EQ(profile.profile, 7);
  EXPECT_EQ(profile.factor_flops, 1 + 4 + 1 + 9);
  EXPECT_EQ(profile.solve_flops(), 28);
  EXPECT_GE(profile.stored, profile.profile);
}

TEST(Skyline, PaddingOfAFiniteElementMatrixStaysSmall) {
  const auto problem = testing::posed({}, testing::catalogue_mesh("Mesh5"));
  const DualSystem system = assemble(problem);
  const SkylineProfile profile = analyse_skyline(system.S);
  EXPECT_LT(static_cast<double>(profile.stored), 1.4 * static_cast<double>(profile.profile));
}

TEST(Skyline, DiagonalIsThatOfLDLT) {
  std::mt19937 generator(5);
  const Eigen::MatrixXd A = random_skyline(
      9, [](int) { return 0; }, generator);
  const SkylineFactor factor = factor_ldlt(analyse_skyline(lower(A), 48), lower(A));
  // One panel of equal rows keeps its order, so D is that of A itself: D_i = L_ii² of Cholesky.
  const Eigen::MatrixXd L = testing::cholesky_factor(A);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(factor.diagonal(i), L(i, i) * L(i, i), 1e-13);
}

TEST(Skyline, IndefiniteButRegularLeadingBlocksAreFine) {
  Eigen::MatrixXd A(3, 3);
  A << 1, 2, 0, 2, 1, 3, 0, 3, 5;  // leading minors 1, −3, −24
  const Eigen::VectorXd b = Eigen::Vector3d(1, 2, 3);
  Eigen::MatrixXd x = b;
  solve_in_place(factor_ldlt(analyse_skyline(lower(A), 1), lower(A)), x);
  EXPECT_LT(relative_residual(A, x, b), 1e-15);
}

TEST(Skyline, LeadingZerosOfTheRightHandSideChangeNothing) {
  std::mt19937 generator(6);
  const Eigen::MatrixXd A = random_skyline(
      300, [](int i) { return std::max(0, i - 30); }, generator);
  const SkylineFactor factor = factor_ldlt(analyse_skyline(lower(A), 16), lower(A));
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(300, 3);
  b.bottomRows(40).setRandom();
  Eigen::MatrixXd x = b;
  solve_in_place(factor, x);
  EXPECT_LT(relative_residual(A, x, b), 1e-15);
}

TEST(Skyline, ZeroRightHandSideGivesExactlyZero) {
  std::mt19937 generator(7);
  const Eigen::MatrixXd A = random_skyline(
      60, [](int) { return 0; }, generator);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(60, 2);
  solve_in_place(factor_ldlt(analyse_skyline(lower(A), 16), lower(A)), x);
  EXPECT_TRUE(x.isZero(0));
}

TEST(Skyline, SingularAndNotFiniteMatricesAreBreakdowns) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(5, 5);
  A(3, 3) = 0;
  EXPECT_THROW(factor_ldlt(analyse_skyline(lower(A), 2),
                           [&] {
                             Eigen::SparseMatrix<double> S = lower(Eigen::MatrixXd::Identity(5, 5));
                             S.coeffRef(3, 3) = 0;
                             return S;
                           }()),
               Breakdown);
  Eigen::SparseMatrix<double> S = lower(Eigen::MatrixXd::Identity(5, 5));
  S.coeffRef(2, 2) = std::nan("");
  try {
    factor_ldlt(analyse_skyline(S, 2), S);
    FAIL() << "a NaN pivot went unnoticed";
  } catch (const Breakdown& breakdown) {
    EXPECT_STREQ(breakdown.what(), "skyline LDLT: pivot 3 is nan");
  }
}

TEST(Skyline, RefusesImpossiblePanelSizes) {
  const Eigen::SparseMatrix<double> S = lower(Eigen::MatrixXd::Identity(5, 5));
  EXPECT_THROW(analyse_skyline(S, 0), std::invalid_argument);
  EXPECT_THROW(analyse_skyline(S, most_panel_rows + 1), std::invalid_argument);
}

TEST(Skyline, DeadlineEndsFactorAndSolve) {
  std::mt19937 generator(8);
  const Eigen::MatrixXd A = random_skyline(
      60, [](int) { return 0; }, generator);
  const SkylineProfile profile = analyse_skyline(lower(A), 16);
  EXPECT_THROW(factor_ldlt(profile, lower(A), Deadline::after(-1)), TimeoutReached);
  const SkylineFactor factor = factor_ldlt(profile, lower(A));
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(60, 1);
  EXPECT_THROW(solve_in_place(factor, x, Deadline::after(-1)), TimeoutReached);
}

}  // namespace
}  // namespace airybench::skyline_test
