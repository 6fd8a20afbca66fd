#include "assembly/nodal_forces.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/traction_forces.hpp"

namespace airybench {
namespace {

// Visits x and the area that it stands for, mm²: integrals of smooth functions over a triangle up
// to its curves.
template <typename Visit>
void for_points(const TriangleVertices& v, const CurvedSides& curves, const Visit& visit) {
  const Eigen::Vector2d centroid = v.rowwise().mean();
  for (int k = 0; k < 3; ++k) {
    const std::vector<Eigen::Vector2d> chord = {v.col(k), v.col((k + 1) % 3)};
    const CurvedThird<double> side(
        {curves[k].is_straight() ? std::span(chord) : curves[k].points_mm, {}, {}}, 1);
    for (int q = 0; q < CurvedThird<double>::points; ++q)
      for (int l = 0; l < CurvedThird<double>::max_layers; ++l) {
        const auto [rho, area] = side.layer(centroid, q, l);
        visit(Eigen::Vector2d(centroid + rho * (side.at(q) - centroid)), area);
      }
  }
}

// DisplacementTriangle::mass up to the curves.
Eigen::MatrixXd mass_up_to(const CurvedSides& curves, const TriangleVertices& v,
                           const TriangleShape& shape, const DisplacementTriangle& element) {
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(element.strains, element.strains);
  for_points(v, curves, [&](const Eigen::Vector2d& x, double area) {
    const Eigen::Vector2d xi = shape.gradients.transpose().lazyProduct(x - v.col(0));
    const Eigen::VectorXd values =
        bernstein_values<double>(element.degree - 1, {1 - xi.x() - xi.y(), xi.x(), xi.y()});
    mass += area / shape.area_mm2 * values.lazyProduct(values.transpose());
  });
  return mass;
}

}  // namespace

DisplacementTriangle::Stiffness triangle_stiffness(const Problem& problem, int degree, int triangle,
                                                   const Eigen::Matrix3d& elasticity) {
  const auto& element = DisplacementTriangle::of_degree(degree);
  const TriangleVertices v = problem.vertices_of(triangle);
  const TriangleShape shape(v);
  if (const auto curves = problem.curves_of(triangle, degree))
    return element.stiffness(shape, elasticity,
                             element.products_of(mass_up_to(*curves, v, shape, element)));
  return element.stiffness(shape, elasticity);
}

namespace {

// ∫ σ:ε(u_i). stress: of a triangle, coefficients of degree p − 1 on all of it.
template <typename Stress>
NodalForces forces_of(const Problem& problem, int p, const Stress& stress) {
  const auto& element = DisplacementTriangle::of_degree(p);
  NodalForces forces{Eigen::Matrix2Xd::Zero(2, displacement_nodes(problem, p))};
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const TriangleShape shape(v);
    const auto curves = problem.curves_of(t, p);
    const DisplacementTriangle::Strain weighted = shape.area_mm2 * stress(t, shape);
    const DisplacementTriangle::Strain dual =
        curves ? weighted.lazyProduct(mass_up_to(*curves, v, shape, element))
               : weighted.lazyProduct(element.mass);
    const DisplacementTriangle::Displacement force = element.forces(shape.gradients, dual);
    forces.largest = std::max(forces.largest, force.cwiseAbs().maxCoeff());
    const auto nodes = triangle_nodes(problem, p, t);
    for (int m = 0; m < element.nodes; ++m) forces.sum.col(nodes[m]) += force.col(m);
  }
  return forces;
}

}  // namespace

NodalForces nodal_forces(const Problem& problem, const DisplacementField& u) {
  const int p = displacement_degree(problem, u);
  const auto& element = DisplacementTriangle::of_degree(p);
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  return forces_of(problem, p, [&](int t, const TriangleShape& shape) {
    DisplacementTriangle::Strain stress = elasticity[problem.mesh.triangle_body[t]].lazyProduct(
        element.strain(shape.gradients, of_triangle(problem, p, u, t)));
    if (problem.is_warm(t)) stress -= thermal_stress(problem, t, p - 1);
    return stress;
  });
}

Eigen::Matrix2Xd thermal_forces(const Problem& problem, int degree) {
  return forces_of(problem, degree,
                   [&](int t, const TriangleShape&) -> DisplacementTriangle::Strain {
                     if (problem.is_warm(t)) return thermal_stress(problem, t, degree - 1);
                     return Eigen::Matrix3Xd::Zero(3, bernstein_count(degree - 1));
                   })
      .sum;
}

namespace {

// ∫ f B_i over an edge that is straight, with f linear between its ends.
template <int p>
void add_traction(const Problem& problem, int row, Eigen::Matrix2Xd& force) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  const EdgeFrame frame = edge_frame(a, b);
  const auto& f = problem.loads.traction_MPa;
  const Eigen::Vector2d at_a = frame.length_mm / 2 * f(a, frame.normal, row),
                        at_b = frame.length_mm / 2 * f(b, frame.normal, row);
  const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
  for (int i = 0; i <= p; ++i)
    force.col(nodes[i]) += edge_moment(1, 0, p, i) * at_a + edge_moment(1, 1, p, i) * at_b;
}

// The same on a curve, where no polynomial of the triangle is zero.
void add_traction_on_curve(const Problem& problem, int row, const DisplacementTriangle& element,
                           const TriangleVertices& v, const DisplacementTriangle::Nodes& nodes,
                           Eigen::Matrix2Xd& force) {
  const TriangleShape shape(v);
  const CurvedSide<double> side({problem.mesh.boundary[row].curve.points_mm, {}, {}}, 1);
  for (int q = 0; q < CurvedSide<double>::points; ++q) {
    const double length = side.normal(q).norm();
    const Eigen::Vector2d f = CurvedSide<double>::weight(q) * length *
                              problem.loads.traction_MPa(side.at(q), side.normal(q) / length, row);
    const Eigen::VectorXd values = element.values(shape, side.at(q) - v.col(0));
    for (int m = 0; m < element.nodes; ++m) force.col(nodes[m]) += values(m) * f;
  }
}

void add_body_force(const Problem& problem, const DisplacementTriangle& element, Sides sides,
                    Eigen::Matrix2Xd& force) {
  const Eigen::Vector2d& b = problem.loads.body_force_N_per_mm3;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto nodes = triangle_nodes(problem, element.degree, t);
    const auto curves =
        sides == Sides::curves ? problem.curves_of(t, element.degree) : std::nullopt;
    if (!curves) {
      for (const int node : nodes) force.col(node) += problem.area_mm2(t) / element.nodes * b;
      continue;
    }
    const TriangleVertices v = problem.vertices_of(t);
    const TriangleShape shape(v);
    for_points(v, *curves, [&](const Eigen::Vector2d& x, double area) {
      const Eigen::VectorXd values = element.values(shape, x - v.col(0));
      for (int m = 0; m < element.nodes; ++m) force.col(nodes[m]) += area * values(m) * b;
    });
  }
}

}  // namespace

Eigen::Matrix2Xd nodal_loads(const Problem& problem, int degree, Sides sides) {
  const auto& element = DisplacementTriangle::of_degree(degree);
  const Mesh& mesh = problem.mesh;
  Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, displacement_nodes(problem, degree));
  if (problem.loads.has_body_force()) add_body_force(problem, element, sides, force);
  if (!problem.loads.traction_MPa) return force;
  const auto follows = [&](int row) {
    return sides == Sides::curves && problem.follows_curve(row, degree);
  };
  with_degree(degree - 1, [&](auto k) {
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
      if (mesh.boundary[row].role == BoundaryRole::force && !follows(row))
        add_traction<k + 1>(problem, row, force);
  });
  for (const auto& [t, rows] : problem.round)
    for (const int row : rows)
      if (row != Problem::no_row && mesh.boundary[row].role == BoundaryRole::force && follows(row))
        add_traction_on_curve(problem, row, element, problem.vertices_of(t),
                              triangle_nodes(problem, degree, t), force);
  return force;
}

double work_of_loads(const Problem& problem, const DisplacementField& u, Sides sides) {
  if (!problem.loads.has_body_force() && !problem.loads.traction_MPa) return 0;
  return nodal_loads(problem, displacement_degree(problem, u), sides).cwiseProduct(u).sum();
}

namespace {

// Of the traction on an edge, with a motion that is linear along it.
double work_of_traction(const Problem& problem, int row, int degree, const FreeMotions& free) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const Eigen::Vector2d &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  const Eigen::Matrix2Xd forces = traction_forces<double>(problem, row, degree);
  double work = 0;
  for (int j = 0; j <= degree; ++j)
    work += forces.col(j).dot(
        free.at(((degree + 1 - j) * a + (j + 1) * b) / (degree + 2), start));  // its moment
  return work;
}

// What the loads do on curved sides more than on their chords.
double work_beyond_chords(const Problem& problem, const FreeMotions& free, int degree) {
  double work = 0;
  for (const auto& [triangle, rows] : problem.round)
    for (int k = 0; k < 3; ++k) {
      const int row = rows[k];
      if (row == Problem::no_row) continue;
      if (problem.loads.traction_MPa && problem.mesh.boundary[row].role == BoundaryRole::force)
        work +=
            work_of_traction(problem, row, degree, free) - work_of_traction(problem, row, 1, free);
      if (!problem.loads.has_body_force()) continue;
      const TriangleVertices v = problem.vertices_of(triangle);
      Eigen::Matrix<double, 2, 3> corners;  // of the third; ∫ of linear functions from them
      corners << v.col(k), v.col((k + 1) % 3), v.rowwise().mean();
      const Eigen::MatrixXd root =
          CurvedThird<double>(problem.curve_of(row, 1), 1).mass_root(corners.col(2));
      const Eigen::Vector3d weight = root.transpose() * root.rowwise().sum();
      for (int i = 0; i < 3; ++i)
        work += (weight(i) - problem.area_mm2(triangle) / 9) *
                problem.loads.body_force_N_per_mm3.dot(
                    free.at(corners.col(i), problem.mesh.boundary[row].vertices[0]));
    }
  return work;
}

}  // namespace

double work_on_free_motion(const Problem& problem, const FreeMotions& free, int degree) {
  if (free.amounts_mm.size() == 0) return 0;
  const DisplacementField motion =
      with_motion(problem, DisplacementField::Zero(2, displacement_nodes(problem)),
                  [&](const auto& x, int vertex) { return free.at(x, vertex); });
  return work_of_loads(problem, motion, Sides::chords) +
         (degree > 1 ? work_beyond_chords(problem, free, degree) : 0);
}

}  // namespace airybench
