#include "solvers/direct/cholmod.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace airybench::cholmod_test {
namespace {

// A grid Laplacian plus a dense coupling of the last unknowns: sparse, positive definite.
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

TEST(Cholmod, TrailingFactorIsThatOfTheSchurComplement) {
  for (const int side : {2, 7, 20}) {
    const Eigen::MatrixXd A = grid_matrix(side);
    const int n = side * side;
    for (const int trailing : {0, 1, side, n - 1}) {
      const int inner = n - trailing;
      CholmodFactor cholesky;
      cholesky.analyse(lower(A), trailing);
      cholesky.factor(lower(A));
      const Eigen::MatrixXd L = cholesky.trailing_factor();
      ASSERT_EQ(L.rows(), trailing);
      if (trailing > 0) {
        const Eigen::MatrixXd schur =
            A.bottomRightCorner(trailing, trailing) -
            A.bottomLeftCorner(trailing, inner) *
                A.topLeftCorner(inner, inner).llt().solve(A.topRightCorner(inner, trailing));
        EXPECT_LE((L * L.transpose() - schur).norm(), 1e-13 * A.norm()) << side << " " << trailing;
      }
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
      const Eigen::VectorXd x = cholesky.backward(cholesky.forward(b));
      EXPECT_LT((A * x - b).norm(), 1e-13 * b.norm());
      EXPECT_GT(cholesky.bytes(), 0u);
    }
  }
}

TEST(Cholmod, TheTrailingPartOfAForwardSolveIsInItsPlace) {
  const Eigen::MatrixXd A = grid_matrix(6);
  CholmodFactor cholesky;
  cholesky.analyse(lower(A), 5);
  cholesky.factor(lower(A));
  // Given the last unknowns, the inner ones follow from the backward sweep alone.
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(36), last = Eigen::VectorXd::LinSpaced(5, 1, 2);
  Eigen::VectorXd z = cholesky.forward(b);
  z.tail(5) = cholesky.trailing_factor().transpose() * last;
  const Eigen::VectorXd x = cholesky.backward(z);
  EXPECT_LT((x.tail(5) - last).norm(), 1e-13);
  EXPECT_LT((A.topRows(31) * x - b.head(31)).norm(), 1e-12);
}

TEST(Cholmod, IndefiniteAndNaNAreBreakdowns) {
  Eigen::MatrixXd A = grid_matrix(4);
  A(7, 7) = -1;
  CholmodFactor cholesky;
  cholesky.analyse(lower(A), 3);
  EXPECT_THROW(cholesky.factor(lower(A)), Breakdown);
  A(7, 7) = std::nan("");
  CholmodFactor other;
  other.analyse(lower(A), 3);
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
  EXPECT_LT((A * x - b).norm(), 1e-13 * b.norm());
  EXPECT_THROW(factor.solve_in_place(x, Deadline::after(-1)), TimeoutReached);
  A(40, 40) = -4;
  EXPECT_THROW(factor.factor(lower(A)), Breakdown);
}

}  // namespace
}  // namespace airybench::cholmod_test
