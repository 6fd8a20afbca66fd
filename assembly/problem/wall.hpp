// Curves: walls that a contact face may meet, and the shape that a face of straight edges stands
// for.
//
// The contact law uses the direction n towards the wall: against a flat wall's normal, radial to a
// round wall, the edge's own normal for a polyline. On a face of many edges the edges' own normals
// would hold each vertex between two of them also along the wall. The gap is
//   g0(x) = t_wall(x) − t_face(x) + clearance,   x + t n on the curve,
// with t_face = 0 for the edge itself. A negative gap is an interference: the body lies inside the
// wall and is pressed back.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace airybench {

// The edge of a half-plane; the normal points out of the wall, towards the bodies.
struct FlatWall {
  Eigen::Vector2d point_mm, normal;
};
// A socket (bodies inside) or a disc (bodies outside).
struct CircularWall {
  Eigen::Vector2d centre_mm;
  double radius_mm;
  enum class Bodies { inside, outside } bodies;
};
// Straight pieces; bodies are on the left of the walk, as with a mesh and its boundary.
struct PolylineWall {
  std::vector<Eigen::Vector2d> points_mm;
};
using Wall = std::variant<FlatWall, CircularWall, PolylineWall>;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Throws TransformError, "key: …: value (allowed: …)": zero normal, radius not positive, fewer than
// two points, equal successive points, non-finite numbers.
void check_curve(const std::string& key, const std::optional<Wall>& wall);

// n at x; none: the edge's own normal.
std::optional<Eigen::Vector2d> direction_towards(const Wall& wall, const Eigen::Vector2d& x);

// t from x to the wall's front along the unit vector m, negative if x is behind it; of several the
// nearest to zero. None: the ray does not cross the front.
std::optional<double> distance_along(const Wall& wall, const Eigen::Vector2d& x,
                                     const Eigen::Vector2d& m);
// The same for both sides of the wall.
std::optional<double> distance_to_either_side(const Wall& wall, const Eigen::Vector2d& x,
                                              const Eigen::Vector2d& m);

}  // namespace airybench
