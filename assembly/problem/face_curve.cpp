#include "assembly/problem/face_curve.hpp"

#include <cmath>

#include "assembly/elements/edge_forces.hpp"
#include "mesh/circle.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {

std::optional<Wall> curve_of(const Mesh& mesh, int boundary_row, const Scene& scene) {
  constexpr double straight = 1e9;  // radius over chord
  const BoundaryEdge& edge = mesh.boundary[boundary_row];
  const std::string label = boundary_label(mesh, edge);
  if (const auto own = scene.boundary.find(label);
      own != scene.boundary.end() && own->second.contact.face)
    return own->second.contact.face;
  if (scene.face && !is_paired(scene, label)) return scene.face;
  if (edge.curve.is_straight()) return {};
  const Eigen::Vector2d &a = edge.curve.points_mm.front(), &b = edge.curve.points_mm.back(),
                        middle = edge.curve.at(0.5);
  const auto circle = circle_through(a, middle, b);
  if (!circle || circle->radius_mm > straight * (b - a).norm())
    return FlatWall{a, Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()).normalized()};
  const bool is_convex = cross_area(a, b, middle) < 0;  // the body is on the left
  return CircularWall{circle->centre_mm, circle->radius_mm,
                      is_convex ? CircularWall::Bodies::inside : CircularWall::Bodies::outside};
}

Eigen::Vector2d normal_of_curve(const Wall& curve, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m) {
  const Eigen::Vector2d n = direction_towards(curve, x).value_or(m);
  return n.dot(m) < 0 ? Eigen::Vector2d(-n) : n;
}

void check_face(const Mesh& mesh, int row, const std::string& label, const Wall& face,
                double allowed_mm) {
  const auto [start, end] = mesh.boundary[row].vertices;
  const Eigen::Vector2d &a = mesh.vertices[start], &b = mesh.vertices[end];
  const Eigen::Vector2d normal = edge_frame(a, b).normal;
  for (const Eigen::Vector2d& point : {a, Eigen::Vector2d((a + b) / 2), b}) {
    const std::optional<double> t = distance_to_either_side(face, point, normal);
    if (t && std::abs(*t) <= allowed_mm) continue;
    refuse(label + ": face", t ? "is " + shown(std::abs(*t)) + " mm" : std::string("is not seen"),
           "from the edge at " + shown(point) + " (allowed: up to " + shown(allowed_mm) +
               " mm, 5 % of the body's size)");
  }
}

}  // namespace airybench
