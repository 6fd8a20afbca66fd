#include "assembly/small_cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace airybench::small_cholesky_test {
namespace {

template <typename Size>
class SmallCholeskyOf : public ::testing::Test {};
template <typename Number, int rows>
struct Of {
  using Scalar = Number;
  static constexpr int n = rows;
};
using Sizes = ::testing::Types<Of<double, 3>, Of<double, 9>, Of<long double, 9>>;
TYPED_TEST_SUITE(SmallCholeskyOf, Sizes);

TYPED_TEST(SmallCholeskyOf, FactorisesAndSolves) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  using Matrix = Eigen::Matrix<Scalar, n, n>;
  constexpr Scalar rounding = 100 * std::numeric_limits<Scalar>::epsilon();
  std::srand(1);
  const Matrix A = Matrix::Random();
  const Matrix S = A * A.transpose() + Matrix::Identity();
  const SmallCholesky<Scalar, n> cholesky(S);
  EXPECT_GT(cholesky.last_pivot(), 0);
  EXPECT_TRUE(cholesky.L().isLowerTriangular(0));
  EXPECT_LT((cholesky.L() * cholesky.L().transpose() - S).norm(), rounding * S.norm());
  Matrix X = Matrix::Identity(), Y = X;
  cholesky.solve(X);
  EXPECT_LT((S * X - Matrix::Identity()).norm(), rounding * S.norm() * X.norm());
  cholesky.solve_lower(Y);
  EXPECT_LT((cholesky.L() * Y - Matrix::Identity()).norm(), rounding * S.norm() * Y.norm());
}

TYPED_TEST(SmallCholeskyOf, AMatrixThatIsNotPositiveDefiniteIsSaidToBeNone) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  using Matrix = Eigen::Matrix<Scalar, n, n>;
  for (const Scalar pivot : {Scalar(0), Scalar(-1), std::numeric_limits<Scalar>::quiet_NaN()}) {
    Matrix S = Matrix::Identity();
    S(n - 2, n - 2) = pivot;
    EXPECT_FALSE((SmallCholesky<Scalar, n>(S).last_pivot() > 0)) << pivot;
  }
}

TYPED_TEST(SmallCholeskyOf, ARootHasTheFactorOfItsNormalMatrix) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n, rows = 2 * n;
  using Root = Eigen::Matrix<Scalar, rows, n>;
  constexpr Scalar rounding = 100 * std::numeric_limits<Scalar>::epsilon();
  std::srand(1);
  Root M = Root::Random();
  // Nearly dependent: the normal matrix itself would have lost this column's sine altogether.
  const Scalar sine = Scalar(1e-10);
  M.col(n - 1) = M.col(0) + sine * M.col(1);
  M.col(1) = Root::Random().col(0);
  const auto cholesky = SmallCholesky<Scalar, n>::of_root(M);
  const auto S = (M.transpose() * M).eval();
  EXPECT_TRUE(cholesky.L().isLowerTriangular(0));
  EXPECT_LT((cholesky.L() * cholesky.L().transpose() - S).norm(), rounding * S.norm());
  EXPECT_GT(cholesky.independence(), sine / 100);
  EXPECT_LT(cholesky.independence(), sine * 100);
  // ‖M x‖ = ‖Lᵀ x‖ where x takes the dependent columns from each other.
  Eigen::Matrix<Scalar, n, 1> x = Eigen::Matrix<Scalar, n, 1>::Zero();
  x(0) = -1;
  x(n - 1) = 1;
  const Scalar length = (M * x).norm();
  EXPECT_LT(std::abs((cholesky.L().transpose() * x).norm() - length), length * rounding / sine);
}

TYPED_TEST(SmallCholeskyOf, ARootOfDependentColumnsIsSaidToBeOne) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  using Root = Eigen::Matrix<Scalar, 2 * n, n>;
  for (const Scalar entry : {Scalar(0), std::numeric_limits<Scalar>::quiet_NaN()}) {
    Root M = Root::Random();
    M.col(1).setConstant(entry);
    EXPECT_FALSE((SmallCholesky<Scalar, n>::of_root(M).independence() > 0)) << entry;
  }
}

}  // namespace
}  // namespace airybench::small_cholesky_test
