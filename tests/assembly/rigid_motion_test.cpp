#include "assembly/problem/rigid_motion.hpp"

#include <gtest/gtest.h>

namespace airybench::rigid_motion_test {
namespace {

const std::vector<PrescribedEdge> corner = {{{0, 0}, {2, 0}}, {{2, 0}, {2, 3}}};

TEST(RigidMotion, ATranslationIsItsOwnToTheLastDigit) {
  for (const double far : {0.1, 100., 1e9}) {
    const Eigen::Vector2d u(0.001, far / 3);
    const SplitDisplacement split =
        split_rigid_motion([u](const Eigen::Vector2d&, int) { return u; }, corner);
    EXPECT_FALSE(split.rest_mm);
    EXPECT_EQ(split.motion.at({17, -4}), u);
  }
}

TEST(RigidMotion, ARotationLeavesNothing) {
  const RigidMotion given{{5, 7}, {0.3, -0.1}, 0.02};
  const SplitDisplacement split =
      split_rigid_motion([&](const Eigen::Vector2d& x, int) { return given.at(x); }, corner);
  EXPECT_FALSE(split.rest_mm);
  EXPECT_NEAR((split.motion.at({-40, 90}) - given.at({-40, 90})).norm(), 0, 1e-13);
}

// What is left is orthogonal to the three rigid motions, and together they are u.
TEST(RigidMotion, IsTheNearestOne) {
  const auto u = [](const Eigen::Vector2d& x, int) -> Eigen::Vector2d {
    return {0.1 + 0.01 * x.x() - 0.02 * x.y(), 0.03 * x.x() + 0.005 * x.y()};
  };
  const SplitDisplacement split = split_rigid_motion(u, corner);
  ASSERT_TRUE(split.rest_mm);
  Eigen::Vector3d work = Eigen::Vector3d::Zero();
  for (const PrescribedEdge& edge : corner)
    for (const auto& [s, weight] : {std::pair{0., 1.}, {0.5, 4.}, {1., 1.}}) {
      const Eigen::Vector2d x = (1 - s) * edge.start + s * edge.end, rest = split.rest_mm(x, 0);
      const double w = weight * (edge.end - edge.start).norm();
      work += w * Eigen::Vector3d(rest.x(), rest.y(), x.x() * rest.y() - x.y() * rest.x());
      EXPECT_NEAR((rest + split.motion.at(x) - u(x, 0)).norm(), 0, 1e-15);
    }
  EXPECT_NEAR(work.norm(), 0, 1e-14);
}

// Three rollers, the third one's tangential displacement of no matter.
TEST(RigidMotion, RollersAreMovedAlongTheirNormals) {
  const std::vector<PrescribedEdge> rollers = {
      {{0, 0}, {2, 0}, 0, true}, {{2, 0}, {2, 3}, 1, true}, {{1, 5}, {0, 4}, 2, true}};
  const RigidMotion given{{5, 7}, {0.3, -0.1}, 0.02};
  const SplitDisplacement split = split_rigid_motion(
      [&](const Eigen::Vector2d& x, int edge) -> Eigen::Vector2d {
        return given.at(x) + (edge == 2 ? 7.0 : 0.0) * Eigen::Vector2d(1, 1);
      },
      rollers);
  EXPECT_FALSE(split.rest_mm);
  EXPECT_NEAR((split.motion.at({-40, 90}) - given.at({-40, 90})).norm(), 0, 1e-12);
}

TEST(RigidMotion, NoDisplacementIsNone) {
  EXPECT_TRUE(split_rigid_motion({}, corner).motion.is_zero());
}

}  // namespace
}  // namespace airybench::rigid_motion_test
