#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "solvers/direct/dense_cholesky.hpp"
#include "solvers/direct/dense_lu.hpp"

namespace airybench::dense_test {
namespace {

Eigen::MatrixXd random_matrix(int n) {
  std::mt19937 bits(11);
  std::uniform_real_distribution<double> number(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(bits); });
}

// Small ones in double, large ones in float and refined; scaled out of a float's range.
TEST(DenseLu, IsBackwardStableAtAnySizeAndScale) {
  for (const int n : {1, 5, 127, 128, 301})
    for (const double scale : {1.0, 1e-60, 1e50}) {
      const Eigen::MatrixXd A = scale * random_matrix(n);
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, 1, 3), x = solve_by_lu(A, b);
      EXPECT_LE((A * x - b).norm(), 1e-13 * (A.norm() * x.norm() + b.norm())) << n << " " << scale;
    }
}

// Where floats cannot settle: a condition number of about 1e11.
TEST(DenseLu, FallsBackToDouble) {
  const int n = 200;
  Eigen::MatrixXd A = random_matrix(n);
  A.row(7) = A.row(8) + 1e-9 * A.row(7);
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(n, 1, 3), b = A * exact,
                        x = solve_by_lu(A, b);
  EXPECT_LE((A * x - b).norm(), 1e-13 * A.norm() * x.norm());
  EXPECT_LT((x - exact).norm(), 1e-2 * exact.norm());
}

TEST(DenseLu, SingularIsNotFinite) {
  for (const int n : {3, 200}) {
    Eigen::MatrixXd A = random_matrix(n);
    A.col(1).setZero();
    EXPECT_FALSE(solve_by_lu(A, Eigen::VectorXd::Ones(n)).allFinite()) << n;
  }
  EXPECT_EQ(solve_by_lu({}, {}).size(), 0);
}

// By Eigen below a size, by LAPACK above it.
TEST(DenseCholesky, IsTheFactorAtAnySize) {
  for (const int n : {1, 47, 48, 90}) {
    const Eigen::MatrixXd root = random_matrix(n), A = root * root.transpose();
    Eigen::MatrixXd L = A;
    ASSERT_TRUE(factorise_in_place(L));
    L.triangularView<Eigen::StrictlyUpper>().setZero();
    EXPECT_LE((L * L.transpose() - A).norm(), 1e-13 * A.norm()) << n;
    const Eigen::MatrixXd inverse = inverse_from_factor(L);
    EXPECT_EQ(inverse, inverse.transpose());
    EXPECT_LE((A * inverse - Eigen::MatrixXd::Identity(n, n)).norm(),
              1e-13 * A.norm() * inverse.norm());
    Eigen::MatrixXd indefinite = -A;
    EXPECT_FALSE(factorise_in_place(indefinite));
  }
}

}  // namespace
}  // namespace airybench::dense_test
