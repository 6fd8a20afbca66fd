// What a method's answer must not depend on: where the body is.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::testing {

// A tooth and the same tooth far from the origin have the same contact forces. solve: a problem.
template <typename Solve>
void expect_the_same_far_from_the_origin(const Solve& solve) {
  Mesh moved = small_tooth(6, 5);
  for (Eigen::Vector2d& x : moved.vertices) x += Eigen::Vector2d(1e5, -2e5);
  Scene scene;
  scene.crown_radius_mm.reset();
  const Solution here = solve(posed(scene)), there = solve(posed(scene, moved));
  ASSERT_EQ(there.status, Status::ok) << there.message;
  // The moved coordinates themselves are rounded to 3e-11 mm.
  EXPECT_LT(distance(here.F_C, there.F_C), 1e-8 * here.F_C.norm());
}

}  // namespace airybench::testing
