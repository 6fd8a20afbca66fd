#include "solvers/direct/mumps.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/dense_algebra.hpp"

namespace airybench::mumps_test {
namespace {

// [A Cᵀ; C 0] with a grid Laplacian A and rows of C that each join two neighbours: indefinite, with
// zeros on the diagonal.
Eigen::MatrixXd saddle_matrix(int side, int constraints) {
  const int n = side * side;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + constraints, n + constraints);
  for (int i = 0; i < n; ++i) {
    M(i, i) = 4.1;
    if ((i + 1) % side != 0) M(i, i + 1) = M(i + 1, i) = -1;
    if (i + side < n) M(i, i + side) = M(i + side, i) = -1;
  }
  for (int k = 0; k < constraints; ++k) {
    M(n + k, 2 * k) = M(2 * k, n + k) = 1 + k;
    M(n + k, 2 * k + 1) = M(2 * k + 1, n + k) = -0.5;
  }
  return M;
}

Eigen::SparseMatrix<double> lower(const Eigen::MatrixXd& A) {
  return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
}

TEST(Mumps, SolvesIndefiniteSystemsForManyColumnsAndCountsNegativePivots) {
  for (const int side : {2, 5, 12}) {
    const int constraints = side * side / 3;
    const Eigen::MatrixXd M = saddle_matrix(side, constraints);
    MumpsFactor factor;
    factor.analyse(lower(M));
    factor.factor(lower(M));
    EXPECT_EQ(factor.negative_pivots(), constraints);
    EXPECT_GT(factor.bytes(), 0u);
    EXPECT_EQ(factor.schur().size(), 0);
    for (const int columns :
         {1, MumpsFactor::columns_at_once, 2 * MumpsFactor::columns_at_once + 3}) {
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(M.rows(), columns);
      Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(M.rows() + 5, columns);  // with an outer stride
      wide.topRows(M.rows()) = b;
      factor.solve_in_place(wide.topRows(M.rows()));
      EXPECT_LT(testing::residual(M, wide.topRows(M.rows()), b), 1e-12 * b.norm()) << side;
      EXPECT_TRUE(wide.bottomRows(5).isZero(0));
    }
    Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(M.rows(), 2);
    factor.solve_in_place(zero);
    EXPECT_TRUE(zero.isZero(0));
  }
}

TEST(Mumps, BelievesThatAMatrixIsPositiveDefiniteAndSaysWhereItIsNot) {
  Eigen::MatrixXd A = saddle_matrix(9, 0);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(A.rows(), 3);
  MumpsFactor factor(MumpsFactor::Definite::yes);
  factor.analyse(lower(A));
  factor.factor(lower(A));
  Eigen::MatrixXd x = b;
  factor.solve_in_place(x);
  EXPECT_LT(testing::residual(A, x, b), 1e-13 * b.norm());
  for (const double pivot : {-4.0, 0.0}) {
    Eigen::MatrixXd other = A;
    other.row(40).setZero();
    other.col(40).setZero();
    other(40, 40) = pivot;
    MumpsFactor indefinite(MumpsFactor::Definite::yes);
    indefinite.analyse(lower(other));
    EXPECT_THROW(indefinite.factor(lower(other)), Breakdown) << pivot;
  }
}

TEST(Mumps, SchurComplementReductionAndExpansionAreThoseOfDenseAlgebra) {
  for (const int side : {2, 7, 15}) {
    const Eigen::MatrixXd M = saddle_matrix(side, side * side / 3);
    const auto size = M.rows();
    for (const Eigen::Index trailing :
         {Eigen::Index{1}, Eigen::Index{side * side / 3}, size - 1}) {  // multipliers, and more
      const Eigen::Index inner = size - trailing;
      const Eigen::MatrixXd A_II = M.topLeftCorner(inner, inner);
      const Eigen::MatrixXd A_CI = M.bottomLeftCorner(trailing, inner);
      const auto lu = testing::factorised(A_II);
      const Eigen::MatrixXd schur =
          M.bottomRightCorner(trailing, trailing) - A_CI * lu(A_CI.transpose());
      MumpsFactor factor;
      factor.analyse(lower(M), static_cast<int>(trailing));
      factor.factor(lower(M));
      ASSERT_EQ(factor.schur().rows(), trailing);
      EXPECT_LT(testing::distance(factor.schur(), schur), 1e-13 * M.norm())
          << side << " " << trailing;
      EXPECT_EQ(testing::distance(factor.schur(), factor.schur().transpose()), 0);
      const Eigen::VectorXd eigenvalues = testing::eigenvalues(A_II);
      EXPECT_EQ(factor.negative_pivots(), (eigenvalues.array() < 0).count());

      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, -1, 2);
      const Eigen::VectorXd reduced = factor.reduce(b);
      EXPECT_LT(testing::distance(reduced, b.tail(trailing) - A_CI * lu(b.head(inner))),
                1e-12 * b.norm());
      const Eigen::VectorXd x = factor.expand(testing::solved(schur, reduced));
      EXPECT_LT(testing::residual(M, x, b), 1e-11 * b.norm());
      // Whatever the trailing unknowns are, the inner equations hold.
      factor.reduce(b);
      const Eigen::VectorXd other = factor.expand(Eigen::VectorXd::Ones(trailing));
      EXPECT_LT(testing::distance(other.tail(trailing), Eigen::VectorXd::Ones(trailing)), 1e-15);
      EXPECT_LT(testing::residual(M.topRows(inner), other, b.head(inner)), 1e-11 * b.norm());
    }
  }
}

TEST(Mumps, SingularMatricesAreBreakdowns) {
  Eigen::MatrixXd M = saddle_matrix(4, 5);
  M.row(17).setZero();
  M.col(17).setZero();
  MumpsFactor factor;
  factor.analyse(lower(M));
  EXPECT_THROW(factor.factor(lower(M)), Breakdown);
}

TEST(Mumps, NotFiniteMatricesAreBreakdowns) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const int trailing : {0, 3}) {
      Eigen::MatrixXd M = saddle_matrix(4, 5);
      M(9, 8) = M(8, 9) = poison;
      MumpsFactor factor;
      EXPECT_THROW(
          {
            factor.analyse(lower(M), trailing);
            factor.factor(lower(M));
          },
          Breakdown)
          << poison;
    }
  }
}

TEST(Mumps, NothingToSolveAndOutOfTime) {
  const Eigen::SparseMatrix<double> nothing(0, 0);
  MumpsFactor none;
  none.analyse(nothing);
  none.factor(nothing);
  Eigen::MatrixXd empty(0, 3);
  none.solve_in_place(empty);
  EXPECT_EQ(none.bytes(), 0u);

  const Eigen::MatrixXd M = saddle_matrix(4, 5);
  MumpsFactor factor;
  factor.analyse(lower(M));
  factor.factor(lower(M));
  Eigen::MatrixXd no_columns(M.rows(), 0);
  factor.solve_in_place(no_columns);
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(M.rows(), 2);
  EXPECT_THROW(factor.solve_in_place(x, Deadline::after(-1)), TimeoutReached);
}

TEST(Mumps, FactorsLiveBesideEachOther) {
  const Eigen::MatrixXd A = saddle_matrix(5, 4), B = saddle_matrix(8, 20);
  MumpsFactor first, second;
  first.analyse(lower(A));
  second.analyse(lower(B), 20);
  first.factor(lower(A));
  second.factor(lower(B));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(A.rows());
  first.solve_in_place(x);
  EXPECT_LT(testing::residual(A, x, Eigen::VectorXd::Ones(A.rows())), 1e-12);
}

}  // namespace
}  // namespace airybench::mumps_test
