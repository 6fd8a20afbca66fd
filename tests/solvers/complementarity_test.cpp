#include "solvers/contact/complementarity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/dice.hpp"

namespace airybench {
namespace {

// Of rigid bodies with few motions and many points with friction: D is of low rank.
struct RigidPoints {
  Eigen::MatrixXd A, b;
};

RigidPoints rigid_points(int motions, int points, double friction, bool on_a_line,
                         testing::Dice& dice) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3 * points, motions);
  for (int p = 0; p < points; ++p)
    for (int m = 0; m < motions; ++m) {
      B(p, m) = on_a_line && m > 0 ? p / 3 - 1. : dice.between(-1, 1);
      B(points + p, m) = dice.between(-1, 1);
      B(2 * points + p, m) = -B(points + p, m);
    }
  RigidPoints result{Eigen::MatrixXd::Zero(4 * points, 4 * points),
                     Eigen::MatrixXd::Zero(4 * points, 2)};
  result.A.topLeftCorner(3 * points, 3 * points) = B * B.transpose();
  for (int p = 0; p < points; ++p) {
    result.A(3 * points + p, p) = friction;
    for (const int side : {points + p, 2 * points + p}) {
      result.A(side, 3 * points + p) = 1;
      result.A(3 * points + p, side) = -1;
    }
    result.b(p, 1) = dice.between(0, 1);
  }
  Eigen::VectorXd load(motions);
  for (double& l : load) l = dice.between(-1, 1);
  result.b.col(0).head(3 * points) = B * load;
  return result;
}

void expect_solved(const RigidPoints& problem, const Eigen::MatrixXd& z) {
  const Eigen::VectorXd w = problem.A * z.col(0) + problem.b.col(0);
  const double size = std::max(1., z.lpNorm<Eigen::Infinity>());
  EXPECT_GT(w.minCoeff(), -1e-9 * size);
  EXPECT_GT(z.col(0).minCoeff(), -1e-9 * size);
  EXPECT_LT(w.cwiseProduct(z.col(0)).cwiseAbs().maxCoeff(), 1e-9 * size * size);
}

TEST(Complementarity, RigidPointsWithFrictionAlwaysHaveASolution) {
  testing::Dice dice(20250311);
  int moved = 0, count = 0;
  for (const double friction : {0.1, 0.5, 2.})
    for (const int points : {1, 2, 4, 8, 13})
      for (const bool on_a_line : {false, true})
        for (int trial = 0; trial < 6; ++trial, ++count) {
          const RigidPoints problem =
              rigid_points(3 * (1 + trial % 3), points, friction, on_a_line, dice);
          const auto z = solve_complementarity(problem.A, problem.b);
          ASSERT_TRUE(z) << friction << " " << points << " " << trial;
          expect_solved(problem, *z);
          moved += z->col(0).isZero(0) ? 0 : 1;
        }
  EXPECT_GT(moved, count / 2);
}

TEST(Complementarity, SmallPartsDecideTies) {
  Eigen::MatrixXd A(2, 2), b(2, 2);
  A << 1, 1, 1, 1;
  b << -1, 2, -1, 3;
  const auto z = solve_complementarity(A, b);  // w = z₁ + z₂ − 1 + 2ε, w' = w + ε
  ASSERT_TRUE(z);
  EXPECT_NEAR((*z)(0, 0), 1, 1e-14);
  EXPECT_NEAR((*z)(0, 1), -2, 1e-14);
  EXPECT_EQ((*z)(1, 0), 0);
}

TEST(Complementarity, WithoutASolutionThereIsNone) {
  Eigen::MatrixXd A(1, 1), b(1, 1);
  A << -1;
  b << -1;  // w = −z − 1
  EXPECT_FALSE(solve_complementarity(A, b));
}

}  // namespace
}  // namespace airybench
