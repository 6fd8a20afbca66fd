#include "bench/plan/face_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "assembly/problem/wall.hpp"

namespace airybench {
namespace {

// Without the rounding of a mesher.
double to_pm(double mm) { return std::round(mm * 1e9) / 1e9 + 0.; }

Eigen::Vector2d rounded(const Eigen::Vector2d& mm) { return {to_pm(mm.x()), to_pm(mm.y())}; }

struct Sums {
  Eigen::Vector2d normal = {0, 0}, moment = {0, 0};  // integrals of n and x over the length
  double length = 0, area = 0;                       // twice the area on the left of closed curves
};

Sums sums_of(const std::vector<FaceCurve>& curves) {
  Sums sums;
  for (const FaceCurve& curve : curves)
    for (const Walk& walk : curve.walks)
      for (std::size_t k = 1; k < walk.size(); ++k) {
        const Eigen::Vector2d along = walk[k] - walk[k - 1];
        sums.normal += Eigen::Vector2d(along.y(), -along.x());
        sums.moment += along.norm() * (walk[k] + walk[k - 1]) / 2;
        sums.length += along.norm();
        sums.area += cross(walk[k - 1] - curves.front().walks.front().front(), along);
      }
  return sums;
}

// Whether every walk goes on where another begins, or where it began.
bool join(const std::vector<FaceCurve>& curves, double length) {
  constexpr double apart = 1e-9;
  const auto any_walk = [&](const auto& is) {
    return std::ranges::any_of(
        curves, [&](const FaceCurve& curve) { return std::ranges::any_of(curve.walks, is); });
  };
  return !any_walk([&](const Walk& walk) {
    return !any_walk(
        [&](const Walk& next) { return (next.front() - walk.back()).norm() <= apart * length; });
  });
}

// How far the curve reaches along a direction: at a vertex, or at an arc's outermost point.
Eigen::Vector2d farthest_of(const FaceCurve& curve, const Eigen::Vector2d& outward) {
  const auto how_far = [&](const Eigen::Vector2d& p) { return p.dot(outward); };
  Eigen::Vector2d farthest = curve.walks.front().front();
  for (const Walk& walk : curve.walks)
    for (std::size_t k = 0; k < walk.size(); ++k) {
      if (how_far(walk[k]) > how_far(farthest)) farthest = walk[k];
      if (k == 0 || !curve.circle) continue;
      // It lies on this edge's arc if the edge's ends lie on either side of it.
      const Eigen::Vector2d apex = curve.circle->centre_mm + curve.circle->radius_mm * outward;
      const Eigen::Vector2d a = walk[k - 1] - curve.circle->centre_mm,
                            b = walk[k] - curve.circle->centre_mm;
      if (a.dot(outward) > 0 && b.dot(outward) > 0 && cross(a, outward) * cross(outward, b) > 0)
        farthest = apex;
    }
  return farthest;
}

// Of a circle around a disc, or in a hole, that the edges just touch.
double radius_touching(const std::vector<FaceCurve>& curves, const Eigen::Vector2d& centre,
                       bool is_disc) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const FaceCurve& curve : curves)
    for (const Walk& walk : curve.walks)
      for (std::size_t k = 1; k < walk.size(); ++k) {
        most = std::max(most, (walk[k] - centre).norm());
        least = std::min(least, ((walk[k - 1] + walk[k]) / 2 - centre).norm());
      }
  return is_disc ? most : least;
}

}  // namespace

std::optional<Circle> circle_of(const std::vector<Walk>& walks) {
  constexpr double allowed = 1e-6, longest_side = 0.9;  // a square's vertices lie on a circle, too
  constexpr double straight = 5e5;                      // radius over chord
  constexpr std::size_t least = 4;
  const Walk& longest = *std::ranges::max_element(walks, {}, &Walk::size);
  if (longest.size() < least) return {};
  const std::size_t third = (longest.size() - 1) / 3;
  const auto circle = circle_through(longest[0], longest[third], longest[2 * third]);
  if (!circle || circle->radius_mm > straight * (longest[2 * third] - longest[0]).norm()) return {};
  for (const Walk& walk : walks)
    for (std::size_t k = 0; k < walk.size(); ++k) {
      const double off = (walk[k] - circle->centre_mm).norm() - circle->radius_mm;
      if (std::abs(off) > allowed * circle->radius_mm) return {};
      if (k > 0 && (walk[k] - walk[k - 1]).norm() > longest_side * circle->radius_mm) return {};
    }
  return circle;
}

std::optional<Circle> common_circle(const std::vector<FaceCurve>& curves) {
  constexpr double same = 1e-6;
  const std::optional<Circle>& first = curves.front().circle;
  if (!first) return {};
  const auto is_other = [&](const FaceCurve& curve) {
    return !curve.circle || (curve.circle->centre_mm - first->centre_mm).norm() +
                                    std::abs(curve.circle->radius_mm - first->radius_mm) >
                                same * first->radius_mm;
  };
  if (std::ranges::any_of(curves, is_other)) return {};
  return first;
}

CircularWall face_on(const Circle& circle) {
  return {rounded(circle.centre_mm), to_pm(circle.radius_mm), {}};
}

Wall wall_at(const std::vector<FaceCurve>& curves) {
  constexpr double closed = 1e-3;
  const Sums sums = sums_of(curves);
  const Eigen::Vector2d middle = sums.moment / sums.length;
  const std::optional<Circle> face = common_circle(curves);
  const bool is_balanced = sums.normal.norm() < closed * sums.length,
             is_closed = is_balanced && join(curves, sums.length),
             is_hollow = face && (face->centre_mm - middle).dot(sums.normal) > 0;
  if (is_closed || is_hollow) {
    const bool is_disc = is_closed && sums.area > 0;
    const Circle round = face ? *face : Circle{middle, radius_touching(curves, middle, is_disc)};
    CircularWall wall = face_on(round);
    wall.bodies = is_disc ? CircularWall::Bodies::inside : CircularWall::Bodies::outside;
    return wall;
  }
  // Sides that look in opposite directions have no wall in common: that of the first.
  const Eigen::Vector2d outward =
      (is_balanced ? sums_of({{{curves.front().walks.front()}, {}}}) : sums).normal.normalized();
  Eigen::Vector2d point = farthest_of(curves.front(), outward);
  for (const FaceCurve& curve : curves)
    if (const Eigen::Vector2d p = farthest_of(curve, outward); p.dot(outward) > point.dot(outward))
      point = p;
  return FlatWall{rounded(point), rounded(-outward)};
}

bool face_each_other(const std::vector<FaceCurve>& one, const std::vector<FaceCurve>& other) {
  struct Edge {
    Eigen::Vector2d middle, normal;
    double length;
  };
  const auto edges_of = [](const std::vector<FaceCurve>& curves) {
    std::vector<Edge> edges;
    for (const FaceCurve& curve : curves)
      for (const Walk& walk : curve.walks)
        for (std::size_t k = 1; k < walk.size(); ++k) {
          const Eigen::Vector2d along = walk[k] - walk[k - 1];
          edges.push_back({(walk[k] + walk[k - 1]) / 2,
                           Eigen::Vector2d(along.y(), -along.x()).normalized(), along.norm()});
        }
    return edges;
  };
  const std::vector<Edge> first = edges_of(one), second = edges_of(other);
  const auto facing = std::ranges::count_if(first, [&](const Edge& a) {
    return std::ranges::any_of(second, [&](const Edge& b) {
      return a.normal.dot(b.normal) < -0.5 &&
             (a.middle - b.middle).norm() <= std::max(a.length, b.length);
    });
  });
  return 3 * facing >= std::ssize(first);
}

std::map<std::string, std::vector<double>> corners_of_curves(const Mesh& mesh, const Scene& scene) {
  constexpr double degree = std::numbers::pi / 180, least = 0.2, most = 35;
  std::map<std::string, std::vector<double>> corners;
  for (const std::vector<int>& chain : boundary_chains(mesh, BoundaryRole::contact))
    for (std::size_t k = 1; k < chain.size(); ++k) {
      const std::string label = boundary_label(mesh, mesh.boundary[chain[k]]);
      const auto given = scene.boundary.find(label);
      const ContactValues own =
          given == scene.boundary.end() ? ContactValues() : given->second.contact;
      const bool is_known = !scene.mesh.polygon &&
                            !mesh.boundary[chain[k - 1]].curve.is_straight() &&
                            !mesh.boundary[chain[k]].curve.is_straight();
      if (is_known || own.face || scene.face || !(own.wall || scene.wall)) continue;
      const auto along = [&](int row) -> Eigen::Vector2d {
        const auto [start, end] = mesh.boundary[row].vertices;
        return mesh.vertices[end] - mesh.vertices[start];
      };
      const Eigen::Vector2d before = along(chain[k - 1]), after = along(chain[k]);
      const double turn = std::abs(std::atan2(cross(before, after), before.dot(after))) / degree;
      if (turn > least && turn < most) corners[label].push_back(turn);
    }
  std::erase_if(corners, [](const auto& of_group) {
    constexpr std::size_t few = 2;  // a body may well have them
    return of_group.second.size() <= few;
  });
  return corners;
}

}  // namespace airybench
