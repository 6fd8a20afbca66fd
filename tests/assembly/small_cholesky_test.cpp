#include "assembly/elements/small_cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/wide.hpp"

namespace airybench::small_cholesky_test {
namespace {

// One type for all sizes: expressions of each would take the compiler seconds.
template <typename Scalar>
using Dense = Eigen::MatrixX<Scalar>;

template <typename Scalar>
Dense<Scalar> product(const Dense<Scalar>& A, const Dense<Scalar>& B) {
  Dense<Scalar> C(A.rows(), B.cols());
  for (Eigen::Index j = 0; j < C.cols(); ++j)
    for (Eigen::Index i = 0; i < C.rows(); ++i) {
      C(i, j) = 0;
      for (Eigen::Index k = 0; k < A.cols(); ++k) C(i, j) += A(i, k) * B(k, j);
    }
  return C;
}
template <typename Scalar>
Scalar distance(const Dense<Scalar>& A, const Dense<Scalar>& B) {
  return (A - B).norm();
}

template <typename Size>
class SmallCholeskyOf : public ::testing::Test {};
template <typename Number, int rows>
struct Of {
  using Scalar = Number;
  static constexpr int n = rows;
};
using Sizes = ::testing::Types<Of<double, 3>, Of<double, 9>, Of<Wide, 9>>;
TYPED_TEST_SUITE(SmallCholeskyOf, Sizes);

TYPED_TEST(SmallCholeskyOf, FactorisesAndSolves) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  const Scalar rounding = 100 * std::numeric_limits<Scalar>::epsilon();
  std::srand(1);
  const Dense<Scalar> I = Dense<Scalar>::Identity(n, n), A = Dense<Scalar>::Random(n, n);
  const Dense<Scalar> S = product<Scalar>(A, A.transpose()) + I;
  const SmallCholesky<Scalar, n> cholesky(S);
  const Dense<Scalar> L = cholesky.L();
  EXPECT_GT(cholesky.last_pivot(), 0);
  EXPECT_TRUE(L.isLowerTriangular(0));
  EXPECT_LT(distance(product<Scalar>(L, L.transpose()), S), rounding * S.norm());
  Eigen::Matrix<Scalar, n, n> solution = I, forward = I;
  cholesky.solve(solution);
  const Dense<Scalar> X = solution;
  EXPECT_LT(distance(product(S, X), I), rounding * S.norm() * X.norm());
  cholesky.solve_lower(forward);
  const Dense<Scalar> Y = forward;
  EXPECT_LT(distance(product(L, Y), I), rounding * S.norm() * Y.norm());
}

TYPED_TEST(SmallCholeskyOf, AMatrixThatIsNotPositiveDefiniteIsSaidToBeNone) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  for (const Scalar pivot : {Scalar(0), Scalar(-1), std::numeric_limits<Scalar>::quiet_NaN()}) {
    Dense<Scalar> S = Dense<Scalar>::Identity(n, n);
    S(n - 2, n - 2) = pivot;
    const SmallCholesky<Scalar, n> cholesky(S);
    EXPECT_FALSE(cholesky.last_pivot() > 0) << static_cast<double>(pivot);
    EXPECT_FALSE(cholesky.independence() > 0) << static_cast<double>(pivot);
  }
}

TYPED_TEST(SmallCholeskyOf, ARootHasTheFactorOfItsNormalMatrix) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n, rows = 2 * n;
  const Scalar rounding = 100 * std::numeric_limits<Scalar>::epsilon();
  std::srand(1);
  Dense<Scalar> M = Dense<Scalar>::Random(rows, n);
  // Nearly dependent: the normal matrix itself would have lost this column's sine altogether.
  const Scalar sine = Scalar(1e-10);
  M.col(n - 1) = M.col(0) + sine * M.col(1);
  M.col(1) = Dense<Scalar>::Random(rows, 1);
  const auto cholesky = SmallCholesky<Scalar, n>::of_root(Eigen::Matrix<Scalar, rows, n>(M));
  const Dense<Scalar> S = product<Scalar>(M.transpose(), M), L = cholesky.L();
  EXPECT_TRUE(L.isLowerTriangular(0));
  EXPECT_LT(distance(product<Scalar>(L, L.transpose()), S), rounding * S.norm());
  EXPECT_GT(cholesky.independence(), sine / 100);
  EXPECT_LT(cholesky.independence(), sine * 100);
  // ‖M x‖ = ‖Lᵀ x‖ where x takes the dependent columns from each other.
  Dense<Scalar> x = Dense<Scalar>::Zero(n, 1);
  x(0) = -1;
  x(n - 1) = 1;
  const Scalar length = product(M, x).norm();
  EXPECT_LT(Eigen::numext::abs(product<Scalar>(L.transpose(), x).norm() - length),
            length * rounding / sine);
}

TYPED_TEST(SmallCholeskyOf, ARootOfDependentColumnsIsSaidToBeOne) {
  using Scalar = typename TypeParam::Scalar;
  constexpr int n = TypeParam::n;
  for (const Scalar entry : {Scalar(0), std::numeric_limits<Scalar>::quiet_NaN()}) {
    Eigen::Matrix<Scalar, 2 * n, n> M = Dense<Scalar>::Random(2 * n, n);
    M.col(1).setConstant(entry);
    EXPECT_FALSE((SmallCholesky<Scalar, n>::of_root(M).independence() > 0))
        << static_cast<double>(entry);
  }
}

}  // namespace
}  // namespace airybench::small_cholesky_test
