#include <gtest/gtest.h>

#include <limits>

#include "solvers/base/dense_products.hpp"
#include "solvers/direct/dense_factors.hpp"
#include "tests/support/dense_operators.hpp"

namespace airybench::dense_test {
namespace {

Eigen::MatrixXd random_matrix(int rows, int columns) {
  std::mt19937 generator(11);
  return testing::random_matrix(rows, columns, generator);
}

Eigen::MatrixXd random_matrix(int n) { return random_matrix(n, n); }

// Blocks of arrays that have more rows; any of them may be empty.
TEST(DenseProducts, AreThoseOfTheDefinition) {
  for (const int m : {0, 1, 5, 70})
    for (const int n : {0, 1, 4})
      for (const int inner : {0, 1, 9}) {
        const Eigen::MatrixXd room = random_matrix(m + n + inner + 3, m + n + inner + 1);
        const auto A = room.block(1, 0, m, inner), B = room.block(2, 0, inner, n);
        const Eigen::MatrixXd product = A.lazyProduct(B), C = room.topRightCorner(m, n);
        const Eigen::MatrixXd A_transposed = A.transpose(), B_transposed = B.transpose();
        Eigen::MatrixXd plain = C, right = C, left = C;
        add_product(-2, A, B, plain);
        add_times_transposed(-2, A, B_transposed, right);
        add_transposed_times(-2, A_transposed, B, left);
        const Eigen::MatrixXd exact = C - 2 * product;
        for (const Eigen::MatrixXd& result : {plain, right, left})
          EXPECT_LE((result - exact).norm(), 1e-14 * (1 + exact.norm())) << m << n << inner;
        if (n == 1) {
          const Eigen::VectorXd x = B;
          EXPECT_LE((times(A, x) - product).norm(), 1e-14 * (1 + product.norm()));
          EXPECT_LE((transposed_times(A_transposed, x) - product).norm(),
                    1e-14 * (1 + product.norm()));
        }
        Eigen::MatrixXd square = Eigen::MatrixXd::Zero(m, m);
        add_square(2, A, square);
        const Eigen::MatrixXd exact_square = 2 * A.lazyProduct(A.transpose());
        for (int j = 0; j < m; ++j)
          EXPECT_LE((square - exact_square).col(j).tail(m - j).norm(),
                    1e-14 * (1 + exact_square.norm()));
      }
}

TEST(TriangularSolves, UndoProductsByTheLowerTriangle) {
  for (const int n : {0, 1, 7, 40})
    for (const int columns : {1, 3})
      for (const Diagonal diagonal : {Diagonal::given, Diagonal::unit}) {
        Eigen::MatrixXd room = random_matrix(n + 2, n) / 8;
        auto L = room.topRows(n);
        L.diagonal().setConstant(diagonal == Diagonal::unit ? 7 : 2);
        Eigen::MatrixXd lower = L.triangularView<Eigen::StrictlyLower>();
        lower.diagonal().setConstant(diagonal == Diagonal::unit ? 1 : 2);
        const Eigen::MatrixXd exact = random_matrix(n, columns);
        Eigen::MatrixXd forward = lower.lazyProduct(exact),
                        backward = lower.transpose().lazyProduct(exact),
                        right = exact.transpose().lazyProduct(lower.transpose());
        solve_lower(L, forward, diagonal);
        solve_lower_transposed(L, backward, diagonal);
        solve_lower_transposed_right(L, right, diagonal);
        for (const Eigen::MatrixXd& X : {forward, backward, Eigen::MatrixXd(right.transpose())})
          EXPECT_LE((X - exact).norm(), 1e-13 * exact.norm()) << n << " " << columns;
      }
}

// Small ones in double, large ones in float and refined; scaled out of a float's range.
TEST(DenseLu, IsBackwardStableAtAnySizeAndScale) {
  for (const int n : {1, 5, 127, 128, 301})
    for (const double scale : {1.0, 1e-60, 1e50}) {
      const Eigen::MatrixXd A = scale * random_matrix(n);
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1, 3), x = solve_by_lu(A, b);
      EXPECT_LE(testing::residual(A, x, b), 1e-13 * (A.norm() * x.norm() + b.norm()))
          << n << " " << scale;
    }
}

// Where floats cannot settle: a condition number of about 1e11.
TEST(DenseLu, FallsBackToDouble) {
  const int n = 200;
  Eigen::MatrixXd A = random_matrix(n);
  A.row(7) = A.row(8) + 1e-9 * A.row(7);
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n, 1, 3), b = A * exact,
                        x = solve_by_lu(A, b);
  EXPECT_LE(testing::residual(A, x, b), 1e-13 * A.norm() * x.norm());
  EXPECT_LT(testing::distance(x, exact), 1e-2 * exact.norm());
}

TEST(DenseLu, SingularIsNotFinite) {
  for (const int n : {3, 200}) {
    Eigen::MatrixXd A = random_matrix(n);
    A.col(1).setZero();
    EXPECT_FALSE(solve_by_lu(A, Eigen::VectorXd::Ones(n)).allFinite()) << n;
  }
  EXPECT_EQ(solve_by_lu({}, {}).size(), 0);
}

// n columns and what is below them, in the lower part of an array that has more of both.
TEST(DenseCholesky, IsTheFirstColumnsOfAFactorOfAnySize) {
  constexpr double stays = 7;
  for (const int n : {1, 7, 8, 9, 20, 47, 48, 64, 65, 150})
    for (const int below : {0, 1, 8, 11, 90}) {
      const int m = n + below;
      const Eigen::MatrixXd root = random_matrix(m), A = root * root.transpose();
      Eigen::MatrixXd room = Eigen::MatrixXd::Constant(m + 3, n + 1, stays);
      room.topLeftCorner(m, n) = A.leftCols(n);
      // Above the diagonal there may be anything.
      for (int j = 1; j < n; ++j)
        room.col(j).head(j).setConstant(std::numeric_limits<double>::quiet_NaN());
      ASSERT_TRUE(factorise_in_place(room.topLeftCorner(m, n)));
      for (int j = 0; j < n; ++j) room.col(j).head(j).setZero();
      const Eigen::MatrixXd L = room.topLeftCorner(m, n);
      EXPECT_LE(testing::residual(L, L.topRows(n).transpose(), A.leftCols(n)), 1e-13 * A.norm())
          << m << " " << n;
      EXPECT_TRUE((room.bottomRows(3).array() == stays).all() &&
                  (room.rightCols(1).array() == stays).all());

      Eigen::MatrixXd rest = A.bottomRightCorner(below, below);
      rest.triangularView<Eigen::StrictlyUpper>().setConstant(
          std::numeric_limits<double>::quiet_NaN());
      add_square(-1, L.bottomRows(below), rest);
      const Eigen::MatrixXd exact =
          A.bottomRightCorner(below, below) - L.bottomRows(below) * L.bottomRows(below).transpose();
      for (int j = 0; j < below; ++j)
        EXPECT_LE((rest - exact).col(j).tail(below - j).norm(), 1e-13 * A.norm());
    }
}

TEST(DenseCholesky, AMatrixThatIsNotPositiveDefiniteIsSaidToBeNone) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const int n : {1, 8, 40, 90})
    for (const int at : {0, n / 2, n - 1})
      for (const double pivot : {0.0, -1.0, infinity, std::nan("")}) {
        Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
        A(at, at) = pivot;
        EXPECT_FALSE(factorise_in_place(A)) << n << " " << at << " " << pivot;
      }
}

TEST(DenseCholesky, ItsInverseIsSymmetric) {
  for (const int n : {1, 47, 48, 90}) {
    const Eigen::MatrixXd root = random_matrix(n), A = root * root.transpose();
    Eigen::MatrixXd L = A;
    ASSERT_TRUE(factorise_in_place(L));
    const Eigen::MatrixXd inverse = inverse_from_factor(L);
    EXPECT_EQ(inverse, inverse.transpose());
    EXPECT_LE(testing::residual(A, inverse, Eigen::MatrixXd::Identity(n, n)),
              1e-13 * A.norm() * inverse.norm());
  }
}

}  // namespace
}  // namespace airybench::dense_test
