#include "assembly/displacement_field.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/edge_forces.hpp"
#include "assembly/small_cholesky.hpp"

namespace airybench {
namespace {

using LocalCoefficients = Eigen::Matrix<double, 2, 6>;

// Without the mean: a translation has no strain, and less cancels.
LocalCoefficients local_coefficients(const Problem& problem, const DisplacementField& u,
                                     int triangle) {
  const std::array<int, 6> nodes = triangle_nodes(problem, triangle);
  LocalCoefficients local;
  for (int m = 0; m < 6; ++m) local.col(m) = u.col(nodes[m]);
  local.colwise() -= local.rowwise().mean().eval();
  return local;
}

// Holds n·u = d. Two rollers that are not parallel hold their common vertex fully.
void hold_along(const Eigen::Vector2d& n, double d, int node, PrescribedDisplacement& prescribed) {
  const auto [other, is_first] = prescribed.normal.try_emplace(node, n);
  if (is_first) {
    prescribed.u.col(node) = d * n;
    return;
  }
  const Eigen::Vector2d m = other->second;
  const double sine = m.x() * n.y() - m.y() * n.x();
  if (std::abs(sine) < straight_roller) return;
  // n·u = d and m·u = c:  u = (c (n_y, −n_x) + d (−m_y, m_x)) / (m × n)
  const double c = m.dot(prescribed.u.col(node));
  prescribed.u.col(node) << (c * n.y() - d * m.y()) / sine, (d * m.x() - c * n.x()) / sine;
  prescribed.at[node] = true;
  prescribed.normal.erase(other);
}

}  // namespace

int displacement_nodes(const Problem& problem) {
  return static_cast<int>(problem.mesh.vertices.size()) + problem.edges.count();
}

std::array<int, 6> triangle_nodes(const Problem& problem, int triangle) {
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  const auto& [a, b, c] = problem.mesh.triangles[triangle];
  const auto& [ab, bc, ca] = problem.edges.of_triangle[triangle];
  return {a, b, c, vertices + ab, vertices + bc, vertices + ca};
}

std::array<int, 3> boundary_nodes(const Problem& problem, int row) {
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  return {a, vertices + problem.edges.of_boundary[row], b};
}

QuadraticStrain quadratic_strain(const TriangleVertices& v) {
  const double twice_area = cross_area(v.col(0), v.col(1), v.col(2));
  QuadraticStrain strain = QuadraticStrain::Zero();
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector2d opposite = v.col((j + 2) % 3) - v.col((j + 1) % 3);
    const Eigen::Vector2d gradient = Eigen::Vector2d(-opposite.y(), opposite.x()) / twice_area;
    for (int k = 0; k < 3; ++k) {  // corner k has the coefficient U_kj
      const int node = k == j ? k : (k + 1) % 3 == j ? 3 + k : 3 + j;
      auto block = strain.block<3, 2>(3 * k, 2 * node);
      block(0, 0) = block(2, 1) = 2 * gradient.x();
      block(1, 1) = block(2, 0) = 2 * gradient.y();
    }
  }
  return strain;
}

QuadraticStiffness quadratic_stiffness(const QuadraticStrain& strain, double area_mm2,
                                       const Eigen::Matrix3d& elasticity) {
  // ∫ λ_m λ_n = area (1 + δ_mn) / 12.
  const Eigen::Matrix<double, 3, 12> sum =
      strain.topRows<3>() + strain.middleRows<3>(3) + strain.bottomRows<3>();
  QuadraticStrain dual;
  for (int k = 0; k < 3; ++k)
    dual.middleRows<3>(3 * k) = area_mm2 / 12 * elasticity * (strain.middleRows<3>(3 * k) + sum);
  return strain.transpose().lazyProduct(dual);
}

Eigen::Matrix3d elasticity_of(const Eigen::Matrix3d& compliance) {
  Eigen::Matrix3d elasticity = Eigen::Matrix3d::Identity();
  SmallCholesky<double, 3>(compliance).solve(elasticity);
  return elasticity;
}

DisplacementField with_rigid_motion(const Problem& problem, DisplacementField w) {
  const auto& x = problem.mesh.vertices;
  const auto vertices = static_cast<Eigen::Index>(x.size());
  for (Eigen::Index v = 0; v < vertices; ++v) w.col(v) += problem.motion.at(x[v]);
  // ρ is linear, so an edge's coefficient is its value at the middle.
  for (int e = 0; e < problem.edges.count(); ++e) {
    const auto [a, b] = problem.edges.vertices[e];
    w.col(vertices + e) += problem.motion.at((x[a] + x[b]) / 2);
  }
  return w;
}

StressField stress_of_displacement(const Problem& problem, const DisplacementField& u) {
  std::vector<Eigen::Matrix3d> elasticity;
  for (const Eigen::Matrix3d& compliance : problem.compliance)
    elasticity.push_back(elasticity_of(compliance));
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const LocalCoefficients local = local_coefficients(problem, u, t);
    Eigen::Matrix3d strain;  // columns: corners
    strain.reshaped() = quadratic_strain(problem.vertices_of(t)).lazyProduct(local.reshaped());
    const Eigen::Matrix3d corners = elasticity[problem.mesh.triangle_body[t]] * strain;
    for (int k = 0; k < 3; ++k)
      field[t].middleCols<3>(3 * k) << corners.col(k), corners.col((k + 1) % 3),
          corners.rowwise().mean();
  }
  return field;
}

NodalForces nodal_forces(const Problem& problem, const StressField& stress) {
  NodalForces forces{Eigen::Matrix2Xd::Zero(2, displacement_nodes(problem))};
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    Eigen::Matrix3d corners;  // values at the vertices; the stress is linear
    corners << stress[t].col(0), stress[t].col(3), stress[t].col(6);
    const Eigen::Matrix3d dual =
        problem.area_mm2(t) / 12 * (corners.colwise() + corners.rowwise().sum());
    const Eigen::Matrix<double, 2, 6> force = quadratic_strain(problem.vertices_of(t))
                                                  .transpose()
                                                  .lazyProduct(dual.reshaped())
                                                  .reshaped(2, 6);
    forces.largest = std::max(forces.largest, force.cwiseAbs().maxCoeff());
    const std::array<int, 6> nodes = triangle_nodes(problem, t);
    for (int m = 0; m < 6; ++m) forces.sum.col(nodes[m]) += force.col(m);
  }
  return forces;
}

Eigen::Matrix2Xd nodal_loads(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const Loads& loads = problem.loads;
  Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, displacement_nodes(problem));
  if (loads.has_body_force())
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (const int node : triangle_nodes(problem, t))
        force.col(node) += problem.area_mm2(t) / 6 * loads.body_force_N_per_mm3;
  if (!loads.traction_MPa) return force;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::force) continue;
    const auto [start, middle, end] = boundary_nodes(problem, row);
    const auto &a = mesh.vertices[start], &b = mesh.vertices[end];
    const EdgeFrame frame = edge_frame(a, b);
    const Eigen::Vector2d at_a = frame.length_mm / 12 * loads.traction_MPa(a, frame.normal, row),
                          at_b = frame.length_mm / 12 * loads.traction_MPa(b, frame.normal, row);
    force.col(start) += 3 * at_a + at_b;
    force.col(middle) += 2 * at_a + 2 * at_b;
    force.col(end) += at_a + 3 * at_b;
  }
  return force;
}

PrescribedDisplacement prescribed_displacement(const Problem& problem) {
  const int nodes = displacement_nodes(problem);
  PrescribedDisplacement prescribed{std::vector<bool>(static_cast<std::size_t>(nodes), false),
                                    {},
                                    DisplacementField::Zero(2, nodes)};
  const auto coefficients = [&](const std::array<int, 3>& on_edge, int row) {
    const auto& u0 = problem.loads.displacement_mm;
    std::array<Eigen::Vector2d, 3> zero;
    zero.fill(Eigen::Vector2d::Zero());
    if (!u0) return zero;
    const auto &a = problem.mesh.vertices[on_edge[0]], &b = problem.mesh.vertices[on_edge[2]];
    return edge_coefficients(u0(a, row), u0((a + b) / 2, row), u0(b, row));
  };
  for (const bool rollers : {true, false})  // full supports last: they win
    for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
      if (problem.mesh.boundary[row].role != BoundaryRole::displacement ||
          problem.is_roller(row) != rollers)
        continue;
      const std::array<int, 3> on_edge = boundary_nodes(problem, row);
      const std::array<Eigen::Vector2d, 3> u = coefficients(on_edge, row);
      const EdgeFrame frame =
          edge_frame(problem.mesh.vertices[on_edge[0]], problem.mesh.vertices[on_edge[2]]);
      for (int k = 0; k < 3; ++k) {
        if (rollers) {
          hold_along(frame.normal, frame.normal.dot(u[k]), on_edge[k], prescribed);
        } else {
          prescribed.at[on_edge[k]] = true;
          prescribed.normal.erase(on_edge[k]);
          prescribed.u.col(on_edge[k]) = u[k];
        }
      }
    }
  return prescribed;
}

double work_of_loads(const Problem& problem, const DisplacementField& u) {
  if (!problem.loads.has_body_force() && !problem.loads.traction_MPa) return 0;
  return nodal_loads(problem).cwiseProduct(u).sum();
}

}  // namespace airybench
