// Circles through points of a boundary.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace airybench {

struct Circle {
  Eigen::Vector2d centre_mm;
  double radius_mm;
};

// None: the points are in line.
inline std::optional<Circle> circle_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                            const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  const double twice_area = u.x() * v.y() - u.y() * v.x();
  if (twice_area == 0) return {};
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const Eigen::Vector2d from_a =
      Eigen::Vector2d(v.y() * uu - u.y() * vv, u.x() * vv - v.x() * uu) / (2 * twice_area);
  return Circle{a + from_a, from_a.norm()};
}

}  // namespace airybench
