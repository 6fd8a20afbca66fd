// What `bench new-scene` proposes for contact faces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/plan/face_curves.hpp"

namespace airybench {
namespace {

constexpr double pi = std::numbers::pi;

// From one angle to another; the body is inside if they ascend.
FaceCurve arc(Eigen::Vector2d centre, double radius, double from, double to, int sides) {
  Walk walk;
  for (int k = 0; k <= sides; ++k) {
    const double angle = from + (to - from) * k / sides;
    walk.emplace_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return {{walk}, circle_of({walk})};
}

TEST(ContactFaces, ACircleIsFoundWhereThereIsOne) {
  const FaceCurve quarter = arc({3, -2}, 1.5, -pi / 2, 0, 3);
  ASSERT_TRUE(quarter.circle.has_value());
  EXPECT_NEAR((quarter.circle->centre_mm - Eigen::Vector2d(3, -2)).norm(), 0, 1e-12);
  EXPECT_NEAR(quarter.circle->radius_mm, 1.5, 1e-12);
  EXPECT_TRUE(arc({0, 0}, 5, 0, 2 * pi, 60).circle);
  EXPECT_FALSE(arc({0, 0}, 5, 0, 2 * pi, 4).circle) << "a square";
  EXPECT_FALSE(arc({0, 0}, 5, 0, 0.5, 2).circle) << "three points";
  EXPECT_FALSE(circle_of({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}})) << "straight";
  EXPECT_FALSE(circle_of({{{-2, 4}, {-1, 1}, {0, 0}, {1, 1}, {2, 4}}})) << "a parabola";
  Walk bent = quarter.walks.front();
  bent[1] += Eigen::Vector2d(1e-4, 0);
  EXPECT_FALSE(circle_of({bent}));
}

TEST(ContactFaces, WallsJustTouch) {
  using enum CircularWall::Bodies;
  const auto circle_at = [](const FaceCurve& curve) {
    return std::get<CircularWall>(wall_at({curve}));
  };
  const CircularWall around = circle_at(arc({1, 2}, 5, 0, 2 * pi, 60));
  EXPECT_EQ(around.bodies, inside);
  EXPECT_EQ(around.radius_mm, 5);
  EXPECT_EQ(circle_at(arc({1, 2}, 5, 2 * pi, 0, 60)).bodies, outside);
  // Half a hole, of a model that is cut at its symmetry.
  EXPECT_EQ(circle_at(arc({1, 2}, 5, pi, 0, 30)).bodies, outside);
  // The lowest point of an arc lies between two vertices.
  const auto flat_at = [](const std::vector<FaceCurve>& curves) {
    return std::get<FlatWall>(wall_at(curves));
  };
  const FlatWall below = flat_at({arc({1, 2}, 5, 1.2 * pi, 1.8 * pi, 7)});
  EXPECT_EQ(below.point_mm, Eigen::Vector2d(1, -3));
  EXPECT_EQ(below.normal, Eigen::Vector2d(0, 1));
  // A fillet ends where its straight sole begins.
  const FaceCurve sole{{{{0, 0}, {9, 0}}}, {}};
  const FlatWall mixed =
      flat_at({arc({0, 1}, 1, pi, 1.5 * pi, 8), sole, arc({9, 1}, 1, 1.5 * pi, 2 * pi, 8)});
  EXPECT_EQ(mixed.normal, Eigen::Vector2d(0, 1));
  EXPECT_NEAR(mixed.point_mm.y(), 0, 1e-9);
  // Two sides that look in opposite directions are no disc: the wall of the first.
  const FlatWall opposite = flat_at({{{{{0, 0}, {9, 0}}, {{9, 4}, {0, 4}}}, {}}});
  EXPECT_EQ(opposite.normal, Eigen::Vector2d(0, 1));
  EXPECT_EQ(opposite.point_mm.y(), 0);
  // A square hole.
  const Walk hole = {{0, 0}, {0, 2}, {2, 2}, {2, 0}, {0, 0}};
  EXPECT_EQ(circle_at({{hole}, circle_of({hole})}).radius_mm, 1);
}

TEST(ContactFaces, AFaceHasOneShape) {
  const FaceCurve left = arc({0, 0}, 1, pi, 1.5 * pi, 8),
                  right = arc({0, 0}, 1, 1.5 * pi, 2 * pi, 8),
                  far = arc({3, 0}, 1, 1.5 * pi, 2 * pi, 8);
  EXPECT_TRUE(common_circle({left, right}));
  EXPECT_FALSE(common_circle({left, far}));
  EXPECT_FALSE(common_circle({left, {{{{0, 0}, {1, 0}}}, {}}}));
}

}  // namespace
}  // namespace airybench
