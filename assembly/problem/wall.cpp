#include "assembly/problem/wall.hpp"

#include <cmath>

#include "assembly/problem/magnitudes.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {
namespace {

struct Crossing {
  double t;
  Eigen::Vector2d normal;
};

std::vector<Crossing> crossings(const FlatWall& wall, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m) {
  const Eigen::Vector2d n = wall.normal.stableNormalized();
  const double slope = n.dot(m);
  if (slope == 0) return {};
  return {{n.dot(wall.point_mm - x) / slope, n}};
}

// |d + t m|² = R², d = x − c: t = −d·m ± √((d·m)² − |d|² + R²), without cancellation.
std::vector<Crossing> crossings(const CircularWall& wall, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m) {
  const Eigen::Vector2d d = x - wall.centre_mm;
  const double half = d.dot(m), power = (d.norm() - wall.radius_mm) * (d.norm() + wall.radius_mm),
               discriminant = half * half - power;
  if (!(discriminant > 0)) return {};
  const double larger = -half - std::copysign(std::sqrt(discriminant), half);
  const double side = wall.bodies == CircularWall::Bodies::inside ? -1 : 1;
  std::vector<Crossing> both;
  for (const double t : {larger, power / larger})
    both.push_back({t, side * (d + t * m) / wall.radius_mm});
  return both;
}

std::vector<Crossing> crossings(const PolylineWall& wall, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m) {
  constexpr double slack = 1e-12;  // share of a piece; closes gaps between pieces
  std::vector<Crossing> all;
  for (std::size_t k = 0; k + 1 < wall.points_mm.size(); ++k) {
    const Eigen::Vector2d &a = wall.points_mm[k], along = wall.points_mm[k + 1] - a;
    const double slope = cross(m, along);
    if (slope == 0) continue;
    const double s = cross(m, x - a) / slope;
    if (s < -slack || s > 1 + slack) continue;
    all.push_back(
        {cross(a - x, along) / slope, Eigen::Vector2d(-along.y(), along.x()).normalized()});
  }
  return all;
}

std::optional<double> nearest(const Wall& wall, const Eigen::Vector2d& x, const Eigen::Vector2d& m,
                              bool front_only) {
  std::optional<double> t;
  for (const Crossing& c : std::visit([&](const auto& w) { return crossings(w, x, m); }, wall))
    if ((!front_only || c.normal.dot(m) < 0) && (!t || std::abs(c.t) < std::abs(*t))) t = c.t;
  return t;
}

void check_point(const std::string& key, const Eigen::Vector2d& point) {
  if (!length_magnitude.has(point)) refuse(key, shown(point), length_magnitude.allowed);
}

void check(const std::string& key, const FlatWall& wall) {
  check_point(key + ": flat: point_mm", wall.point_mm);
  if (!wall.normal.allFinite() || wall.normal.isZero(0))
    refuse(key + ": flat: normal", shown(wall.normal), "(allowed: finite, not zero)");
}

void check(const std::string& key, const CircularWall& wall) {
  check_point(key + ": circle: centre_mm", wall.centre_mm);
  if (!(wall.radius_mm > 0 && length_magnitude.has(wall.radius_mm)))
    refuse(key + ": circle: radius_mm", shown(wall.radius_mm), "(allowed: > 0, up to 1e15 mm)");
}

void check(const std::string& key, const PolylineWall& wall) {
  const auto& points = wall.points_mm;
  if (points.size() < 2)
    refuse(key + ": polyline", std::to_string(points.size()) + " point(s)",
           "(allowed: at least 2)");
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::string name = key + ": polyline: point " + std::to_string(k + 1);
    check_point(name, points[k]);
    if (k > 0 && points[k] == points[k - 1])
      refuse(name, shown(points[k]), "again (allowed: different points)");
  }
}

}  // namespace

void check_curve(const std::string& key, const std::optional<Wall>& wall) {
  if (wall) std::visit([&](const auto& w) { check(key, w); }, *wall);
}

std::optional<Eigen::Vector2d> direction_towards(const Wall& wall, const Eigen::Vector2d& x) {
  if (const auto* flat = std::get_if<FlatWall>(&wall)) return -flat->normal.stableNormalized();
  if (const auto* round = std::get_if<CircularWall>(&wall); round && x != round->centre_mm) {
    const double side = round->bodies == CircularWall::Bodies::inside ? 1 : -1;
    return side * (x - round->centre_mm).normalized();
  }
  return {};
}

std::optional<double> distance_along(const Wall& wall, const Eigen::Vector2d& x,
                                     const Eigen::Vector2d& m) {
  return nearest(wall, x, m, true);
}

std::optional<double> distance_to_either_side(const Wall& wall, const Eigen::Vector2d& x,
                                              const Eigen::Vector2d& m) {
  return nearest(wall, x, m, false);
}

}  // namespace airybench
