// Curves that a contact face may meet, its walls, and what a face made of straight edges stands
// for.
//
// The contact law is about the direction n towards the wall: against the normal of a flat one,
// radial to a round one, along the edge's own normal to a polyline. On a face of many edges the
// edges' own normals would hold each vertex between two of them also along the wall.
//   g0(x) = t_wall(x) − t_face(x) + clearance,   x + t n on the curve;  t_face = 0: the edge
//   itself.
// A negative gap is an interference: the body is drawn into the wall and is pressed back.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace airybench {

// The rim of a half-plane; the normal leads out of the wall, to where bodies are.
struct FlatWall {
  Eigen::Vector2d point_mm, normal;
};
// A socket, bodies are inside, or a disc, bodies are outside.
struct CircularWall {
  Eigen::Vector2d centre_mm;
  double radius_mm;
  enum class Bodies { inside, outside } bodies;
};
// Straight pieces; bodies are on the left of the walk, as a mesh is of its boundary.
struct PolylineWall {
  std::vector<Eigen::Vector2d> points_mm;
};
using Wall = std::variant<FlatWall, CircularWall, PolylineWall>;

// a × b.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Throws TransformError, "key: …: value (allowed: …)": a normal that is zero, a radius that is not
// positive, fewer than two points, two successive ones that are one, numbers that are not finite.
void check_curve(const std::string& key, const std::optional<Wall>& wall);

// n at x; none: the edge's own.
std::optional<Eigen::Vector2d> direction_towards(const Wall& wall, const Eigen::Vector2d& x);

// t from x to the wall along the unit vector m, negative where x is behind it; of several the one
// nearest to zero. None: the ray misses, or leaves the wall's back.
std::optional<double> distance_along(const Wall& wall, const Eigen::Vector2d& x,
                                     const Eigen::Vector2d& m);
// The same whatever the side that bodies are on.
std::optional<double> distance_to_either_side(const Wall& wall, const Eigen::Vector2d& x,
                                              const Eigen::Vector2d& m);

}  // namespace airybench
