#include "solvers/direct/condition.hpp"

#include <gtest/gtest.h>

#include "tests/support/dense_operators.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::condition_test {
namespace {

double norm_1(const Eigen::MatrixXd& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

double exact_condition(const Eigen::MatrixXd& A) {
  return norm_1(A) * norm_1(testing::factorised(A)(Eigen::MatrixXd::Identity(A.rows(), A.rows())));
}

double estimate(const Eigen::MatrixXd& A) {
  const auto lu = testing::factorised(A);
  return estimate_condition(testing::lower_of(A),
                            [&](Eigen::Ref<Eigen::MatrixXd> X) { X = lu(X); });
}

Eigen::MatrixXd equilibrated(const Eigen::MatrixXd& A) {
  const Eigen::VectorXd d = A.diagonal().cwiseSqrt().cwiseInverse();
  return d.asDiagonal() * A * d.asDiagonal();
}

// Random eigenvectors, eigenvalues from 1 down to 1/kappa.
Eigen::MatrixXd random_definite(int n, double kappa) {
  return testing::with_eigenvalues(
      testing::orthogonal_factor(Eigen::MatrixXd::Random(n, n)),
      Eigen::VectorXd::LinSpaced(n, 0, -std::log(kappa)).array().exp().matrix());
}

TEST(ConditionEstimate, IsAtMostTheExactOneAndAtLeastAThird) {
  std::srand(4);
  for (const int n : {1, 2, 5, 20, 60})
    for (const double kappa : {1.0, 1e3, 1e8}) {
      const Eigen::MatrixXd A = random_definite(n, kappa);
      const double exact = exact_condition(equilibrated(A)), estimated = estimate(A);
      EXPECT_LE(estimated, exact * (1 + 1e-6)) << n << " " << kappa;
      EXPECT_GE(estimated, exact / 3) << n << " " << kappa;
    }
}

TEST(ConditionEstimate, DoesNotSeeTheUnits) {
  std::srand(5);
  const Eigen::MatrixXd A = random_definite(30, 1e4);
  const Eigen::VectorXd units = (8 * Eigen::VectorXd::Random(30)).array().exp().matrix();
  EXPECT_NEAR(estimate(units.asDiagonal() * A * units.asDiagonal()) / estimate(A), 1, 1e-6);
}

TEST(ConditionEstimate, TakesRowsWithoutADiagonal) {
  std::srand(6);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(24, 24);
  M.topLeftCorner(18, 18) = equilibrated(random_definite(18, 1e4));
  M.bottomLeftCorner(6, 18) = Eigen::MatrixXd::Random(6, 18);
  for (int i = 18; i < 24; ++i) M.row(i) /= M.row(i).cwiseAbs().maxCoeff();
  M.topRightCorner(18, 6) = M.bottomLeftCorner(6, 18).transpose();
  const double exact = exact_condition(M);
  EXPECT_LE(estimate(M), exact * (1 + 1e-6));
  EXPECT_GE(estimate(M), exact / 3);
  M.bottomRows(6) *= 1e5;  // other units of the multipliers
  M.rightCols(6) *= 1e5;
  EXPECT_NEAR(estimate(M) / exact, 2. / 3, 1. / 3 + 1e-6);
}

TEST(ConditionEstimate, ASingularMatrixIsInfinite) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(3, 3);
  EXPECT_FALSE(estimate(A) < 1e15);
}

// κ₁ lies between κ₂ and n κ₂. κ₂ by extreme eigenvalues: of S and K with unit diagonal 5.5e5 and
// about 1e4 on Mesh0 (docs/theory-displacements.md).
TEST(ConditionEstimate, OfEveryMethodThatFactorises) {
  const AirySystem system = testing::system_of({}, testing::catalogue_mesh("Mesh0"));
  RunControl control;
  control.condition = true;
  const auto of = [&](const char* name) {
    return testing::solved_by(name, system, control).condition_estimate.value_or(0);
  };
  const double S = of("3STEPD"), K = of("HYBRID"), M = of("BLIND");
  EXPECT_GT(S, 5.5e5);
  EXPECT_LT(S, 5.5e5 * system.n());
  EXPECT_NEAR(of("3STEPD:CHOLMOD") / S, 1, 1e-6);
  EXPECT_GT(K, 9e3);
  EXPECT_LT(K, S / 5);
  EXPECT_GT(M, 1e3);
  EXPECT_NEAR(of("BLIND:SKY") / M, 1, 1e-6);
  EXPECT_FALSE(testing::solved_by("HYBRID", system).condition_estimate);
}

}  // namespace
}  // namespace airybench::condition_test
