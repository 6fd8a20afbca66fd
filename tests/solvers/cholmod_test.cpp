#include "solvers/direct/cholmod.hpp"

#include <gtest/gtest.h>

#include "tests/support/dense_algebra.hpp"

namespace airybench::cholmod_test {
namespace {

// A shifted grid Laplacian.
Eigen::MatrixXd grid_matrix(int side) {
  const int n = side * side;
  Eigen::MatrixXd A = 4.1 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) {
    if ((i + 1) % side != 0) A(i, i + 1) = A(i + 1, i) = -1;
    if (i + side < n) A(i, i + side) = A(i + side, i) = -1;
  }
  return A;
}

Eigen::SparseMatrix<double> lower(const Eigen::MatrixXd& A) {
  return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
}

TEST(Cholmod, IndefiniteAndNaNAreBreakdowns) {
  Eigen::MatrixXd A = grid_matrix(4);
  A(7, 7) = -1;
  CholmodFactor cholesky;
  cholesky.analyse(lower(A));
  EXPECT_THROW(cholesky.factor(lower(A)), Breakdown);
  A(7, 7) = std::nan("");
  CholmodFactor other;
  other.analyse(lower(A));
  EXPECT_THROW(other.factor(lower(A)), Breakdown);
}

TEST(Cholmod, SolvesAndRefuses) {
  Eigen::MatrixXd A = grid_matrix(9);
  CholmodFactor factor;
  factor.analyse(lower(A));
  factor.factor(lower(A));
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(81, 70);
  Eigen::MatrixXd x = b;
  factor.solve_in_place(x);
  EXPECT_LT(testing::residual(A, x, b), 1e-13 * b.norm());
  EXPECT_GT(factor.bytes(), 0u);
  EXPECT_THROW(factor.solve_in_place(x, Deadline::after(-1)), TimeoutReached);
  A(40, 40) = -4;
  EXPECT_THROW(factor.factor(lower(A)), Breakdown);
}

TEST(Cholmod, InvertsTheSchurComplementOfTheLastUnknowns) {
  for (const int side : {1, 2, 9, 16}) {
    const Eigen::MatrixXd A = grid_matrix(side);
    const auto size = A.rows();
    const Eigen::MatrixXd inverse = testing::solved(A, Eigen::MatrixXd::Identity(size, size));
    for (const Eigen::Index trailing : {Eigen::Index{0}, (size + 2) / 3, size}) {
      CholmodFactor factor;
      factor.analyse(lower(A), static_cast<int>(trailing));
      factor.factor(lower(A));
      const Eigen::MatrixXd found = factor.inverse_of_schur();
      ASSERT_EQ(found.rows(), trailing);
      EXPECT_LE(testing::distance(found, inverse.bottomRightCorner(trailing, trailing)), 1e-13)
          << side << " " << trailing;
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(size, 3);
      Eigen::MatrixXd x = b;
      factor.solve_in_place(x);
      EXPECT_LT(testing::residual(A, x, b), 1e-13 * b.norm());
    }
  }
}

// Of the star c–p, a–p, a–s, p–s with C = {c, p, s} the factor has c before a, and small supernodes
// are merged.
TEST(Cholmod, InvertsTheSchurComplementOfUnknownsThatAreNotJoined) {
  Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(4, 4);  // a, c, p, s
  for (const auto& [i, j] : {std::pair(0, 2), {0, 3}, {2, 3}, {1, 2}}) A(i, j) = A(j, i) = -1;
  CholmodFactor factor;
  factor.analyse(lower(A), 3);
  factor.factor(lower(A));
  const Eigen::MatrixXd inverse = testing::solved(A, Eigen::MatrixXd::Identity(4, 4));
  EXPECT_LE(testing::distance(factor.inverse_of_schur(), inverse.bottomRightCorner(3, 3)), 1e-14);
}

}  // namespace
}  // namespace airybench::cholmod_test
