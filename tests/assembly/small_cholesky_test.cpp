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

}  // namespace
}  // namespace airybench::small_cholesky_test
