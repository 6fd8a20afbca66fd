#include "verify/geometry_error.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <optional>

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "mesh/boundary_sides.hpp"
#include "mesh/curved_groups.hpp"
#include "mesh/interfaces.hpp"
#include "mesh/supposed_curves.hpp"

namespace airybench {
namespace {

constexpr double of_loaded = 1.5, of_held = 0.3;  // c

// What an edge stands for.
struct TrueSide {
  const EdgeCurve* curve = nullptr;       // its own
  std::optional<SupposedCurve> supposed;  // or that of the side it is a part of

  bool is_edge() const { return !curve && !supposed; }
  Eigen::Vector2d normal_at(double s, const EdgeFrame& chord) const {
    if (curve) return curve->normal(s);
    const double angle = (1 - s) * supposed->from_rad + s * supposed->to_rad;
    return std::cos(angle) * chord.normal + std::sin(angle) * chord.tangent;
  }
};

// ∂u/∂n of a strain (xx, yy, xy doubled) where u does not change along the edge, in its frame.
Eigen::Vector2d change_across(const Eigen::Vector3d& strain, const EdgeFrame& edge) {
  const Eigen::Vector2d of_normal = traction({strain(0), strain(1), strain(2) / 2}, edge.normal);
  return {edge.normal.dot(of_normal), 2 * edge.tangent.dot(of_normal)};
}

std::vector<Eigen::Vector3d> stresses_along(const StressField& stress, const TriangleSide& side) {
  std::vector<Eigen::Vector3d> along;
  for (int j = 0; j <= stress.degree(); ++j)
    along.emplace_back(stress[static_cast<std::size_t>(side.triangle)].col(
        side.k * bernstein_count(stress.degree()) + j));
  return along;
}

// Of the side k of a triangle, a row of Mesh::boundary.
double squared_error(const Problem& problem, const StressField& stress, int triangle, int k,
                     int row, const TrueSide& side) {
  using Points = boost::math::quadrature::gauss<double, 2 * highest_stress_degree + 2>;
  const BoundaryEdge& edge = problem.mesh.boundary[row];
  const Eigen::Vector2d &a = problem.mesh.vertices[edge.vertices[0]],
                        &b = problem.mesh.vertices[edge.vertices[1]];
  const EdgeFrame chord = edge_frame(a, b);
  const std::vector<Eigen::Vector3d> along = stresses_along(stress, {triangle, k});
  const Eigen::Matrix3d& compliance = problem.compliance_of(triangle);
  const bool is_held = edge.role == BoundaryRole::displacement && !problem.is_roller(row);
  const auto density = [&](double s) {  // |r|²/E
    const Eigen::Vector2d normal = side.normal_at(s, chord);
    const Eigen::Vector3d sigma = bernstein_value(along, s);
    if (is_held) {
      Eigen::Vector3d strain = compliance * sigma;
      if (problem.is_warm(triangle))
        strain.head<2>().array() += problem.thermal_strain(triangle).at((1 - s) * a + s * b);
      return change_across(strain, chord).squaredNorm() / compliance(0, 0) *
             (normal - chord.normal).squaredNorm();
    }
    Eigen::Vector2d r = -traction(sigma, normal - chord.normal);
    if (edge.role == BoundaryRole::force && problem.loads.traction_MPa) {
      const Eigen::Vector2d x = (1 - s) * a + s * b;
      r += problem.loads.traction_MPa(x, normal, row) -
           problem.loads.traction_MPa(x, chord.normal, row);
    }
    return r.squaredNorm() * compliance(0, 0);
  };
  const double side_mm = side.supposed ? side.supposed->side_mm : chord.length_mm;
  return (is_held ? of_held : of_loaded) * side_mm * chord.length_mm *
         Points::integrate(density, 0., 1.);
}

// Of an edge between two materials: the softer one's.
double squared_error_between(const Problem& problem, const StressField& stress,
                             const std::array<TriangleSide, 2>& sides, const SupposedCurve& curve) {
  using Points = boost::math::quadrature::gauss<double, 2 * highest_stress_degree + 2>;
  const auto [t, k] = sides[0];
  const TriangleVertices v = problem.vertices_of(t);
  const EdgeFrame chord = edge_frame(v.col(k), v.col((k + 1) % 3));
  const TrueSide line{nullptr, curve};
  const std::vector<Eigen::Vector3d> own = stresses_along(stress, sides[0]),
                                     other = stresses_along(stress, sides[1]);
  const auto squared = [&](double s) {
    const Eigen::Vector3d jump = bernstein_value(own, s) - bernstein_value(other, 1 - s);
    return traction(jump, line.normal_at(s, chord) - chord.normal).squaredNorm();
  };
  const double compliance =
      std::max(problem.compliance_of(t)(0, 0), problem.compliance_of(sides[1].triangle)(0, 0));
  return of_loaded * curve.side_mm * chord.length_mm * compliance *
         Points::integrate(squared, 0., 1.);
}

std::vector<Interface> interfaces_of_materials(const Problem& problem) {
  bool all_alike = true;
  for (int body = 1; body < static_cast<int>(problem.compliance.size()); ++body)
    all_alike = all_alike && problem.strain_alike(0, body);
  if (all_alike) return {};
  std::vector<Interface> found = interfaces(problem.mesh, problem.edges);
  std::erase_if(found, [&](const Interface& one) {
    return problem.strain_alike(one.bodies[0], one.bodies[1]);
  });
  return found;
}

// The largest of the triangle's 1/sin³ of an angle: its smallest one's.
double steepness(const TriangleVertices& v) {
  double sine = 1;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d a = v.col((k + 1) % 3) - v.col(k), b = v.col((k + 2) % 3) - v.col(k);
    sine = std::min(sine, (a.x() * b.y() - a.y() * b.x()) / (a.norm() * b.norm()));
  }
  return 1 / (sine * sine * sine);
}

double squared_error_on_curve(const Problem& problem, const StressField& stress, int triangle,
                              int k, int row) {
  const BoundaryRole role = problem.mesh.boundary[row].role;
  const bool is_roller = problem.is_roller(row);
  if (role == BoundaryRole::displacement && !is_roller) return 0;
  const int degree = stress.degree();
  const double constant = std::exp2(1 - degree);
  const TriangleVertices v = problem.vertices_of(triangle);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  const SideCurve curve = problem.curve_of(row, degree);
  const CurvedSide<double> side(curve, degree);
  const auto of_third = stress[static_cast<std::size_t>(triangle)].middleCols(
      k * bernstein_count(degree), bernstein_count(degree));
  const ForcesOnEdge forces =
      curved_edge_forces(v, stress[static_cast<std::size_t>(triangle)], k, curve);
  double sum = 0;  // ∫ |r|² ds
  for (int q = 0; q < CurvedSide<double>::points; ++q) {
    const double length = side.normal(q).norm();
    const Eigen::Vector2d n = side.normal(q) / length;
    Eigen::Vector2d r = -traction(of_third * side.bernstein(centroid, q, 1), n);
    if (role == BoundaryRole::contact)
      r += side.density(forces, q) / length;
    else if (role == BoundaryRole::force && problem.loads.traction_MPa)
      r += problem.loads.traction_MPa(side.at(q), n, row);
    if (is_roller) r -= n * n.dot(r);  // it reacts
    sum += CurvedSide<double>::weight(q) * length * r.squaredNorm();
  }
  return constant * steepness(v) * (v.col((k + 1) % 3) - v.col(k)).norm() *
         problem.compliance_of(triangle)(0, 0) * sum;
}

}  // namespace

GeometryError geometry_error(const Problem& problem, const StressField& stress) {
  GeometryError error = {std::vector<double>(stress.size(), 0),
                         std::vector<double>(stress.size(), 0)};
  if (stress.degree() > 1)
    for (const Problem::RoundTriangle& round : problem.round)
      for (int k = 0; k < 3; ++k)
        if (round.rows[k] != Problem::no_row)
          error.of_triangle_Nmm[round.triangle] +=
              squared_error_on_curve(problem, stress, round.triangle, k, round.rows[k]);
  const auto& boundary = problem.mesh.boundary;
  std::vector<TrueSide> side(boundary.size());
  for (std::size_t row = 0; row < boundary.size(); ++row)
    if (!boundary[row].curve.is_straight() &&
        !problem.follows_curve(static_cast<int>(row), stress.degree()))
      side[row].curve = &boundary[row].curve;
  for (const SupposedCurve& curve : supposed_curves(problem.mesh))
    side[static_cast<std::size_t>(curve.boundary_row)].supposed = curve;
  const std::vector<TriangleSide> sides = boundary_sides(problem.edges);
  for (std::size_t row = 0; row < boundary.size(); ++row) {
    if (side[row].is_edge()) continue;
    const auto [t, k] = sides[row];
    const double squared = squared_error(problem, stress, t, k, static_cast<int>(row), side[row]);
    error.of_triangle_Nmm[t] += squared;
    if (side[row].curve) error.of_chords_Nmm[t] += squared;
  }
  for (const Interface& interface : interfaces_of_materials(problem))
    for (const SupposedCurve& curve : supposed_curves(interface.line)) {
      const std::array<TriangleSide, 2>& of_edge =
          interface.sides[static_cast<std::size_t>(curve.boundary_row)];
      const double squared = squared_error_between(problem, stress, of_edge, curve);
      for (const TriangleSide& own : of_edge) error.of_triangle_Nmm[own.triangle] += squared / 2;
    }
  return error;
}

std::string polygon_groups(const Problem& problem, int degree) {
  const Mesh& mesh = problem.mesh;
  CurvedGroups groups;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (const BoundaryEdge& edge = mesh.boundary[row];
        !edge.curve.is_straight() && !problem.follows_curve(row, degree))
      groups.add(boundary_label(mesh, edge), edge.curve.sagitta());
  for (const SupposedCurve& curve : supposed_curves(mesh))
    groups.add(boundary_label(mesh, mesh.boundary[curve.boundary_row]), curve.sagitta_mm());
  for (const Interface& interface : interfaces_of_materials(problem))
    for (const SupposedCurve& curve : supposed_curves(interface.line))
      groups.add("between " + mesh.body_names[interface.bodies[0]] + " and " +
                     mesh.body_names[interface.bodies[1]],
                 curve.sagitta_mm());
  return groups.words();
}

}  // namespace airybench
