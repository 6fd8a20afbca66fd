#include "assembly/control_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "assembly/edge_forces.hpp"

namespace airybench {

std::array<double, 3> gap_coefficients(const Problem& problem, int boundary_row) {
  const auto& gap = problem.loads.gap_mm;
  if (!gap) return {0, 0, 0};
  const auto [start, end] = problem.mesh.boundary[boundary_row].vertices;
  const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  return edge_coefficients(gap(a, boundary_row), gap((a + b) / 2, boundary_row),
                           gap(b, boundary_row));
}

ControlPoints control_points(const Problem& problem) {
  ControlPoints points;
  points.law.components = problem.has_friction() ? 2 : 1;
  const Mesh& mesh = problem.mesh;
  std::vector<double> gap, friction;    // g0, μ
  std::vector<Eigen::Vector2d> motion;  // ρ
  std::vector<double> slid;             // what slip is measured from
  std::optional<PrescribedDisplacement> prescribed;
  std::map<int, int> point_of_node;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    if (edge.role != BoundaryRole::contact) continue;
    if (!prescribed) prescribed = prescribed_displacement(problem);
    const auto &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    const std::array<int, 3> nodes = boundary_nodes(problem, row);
    const std::array<double, 3> gaps = gap_coefficients(problem, row);
    for (int k = 0; k < 3; ++k) {
      if (prescribed->at[nodes[k]]) continue;
      const EdgeFrame frame = problem.frame_at_node(row, k);
      if (const auto roller = prescribed->normal.find(nodes[k]);
          roller != prescribed->normal.end()) {
        const Eigen::Vector2d& m = roller->second;
        const Eigen::Vector2d along(-m.y(), m.x());
        const double cosine = frame.normal.dot(along);
        if (std::abs(cosine) < straight_roller) continue;  // in line: the roller holds u_n
        points.node.push_back(nodes[k]);
        points.normal.push_back(cosine > 0 ? along : Eigen::Vector2d(-along));
        points.on_roller.push_back(true);
        points.law.boundary.push_back(row);
        const Eigen::Vector2d held =
            prescribed->u.col(nodes[k]) + problem.motion.at(a + k * (b - a) / 2);
        gap.push_back((gaps[k] - frame.normal.dot(held)) / std::abs(cosine));
        motion.emplace_back(0, 0);
        friction.push_back(problem.friction_at(row));
        slid.push_back(0);
        continue;
      }
      const auto [found, is_new] =
          point_of_node.try_emplace(nodes[k], static_cast<int>(points.node.size()));
      if (is_new) {
        points.node.push_back(nodes[k]);
        points.normal.push_back(frame.normal);
        points.on_roller.push_back(false);
        points.law.boundary.push_back(row);
        friction.push_back(problem.friction_at(row));
        gap.push_back(gaps[k]);
        motion.push_back(problem.motion.at(a + k * (b - a) / 2));  // ρ is linear: its coefficients
        slid.push_back(problem.slid_at(row)[k]);
      } else {
        const int p = found->second;
        points.normal[p] = (points.normal[p] + frame.normal).normalized();
        gap[p] = std::min(gap[p], gaps[k]);
        friction[p] = std::min(friction[p], problem.friction_at(row));
      }
    }
  }
  points.law.count = static_cast<int>(points.node.size());
  if (points.law.components == 2) points.law.friction = std::move(friction);
  if (problem.has_gap() || std::ranges::any_of(gap, [](double g) { return g != 0; })) {
    const int m = points.law.components;
    points.law.gap.resize(points.law.size());
    for (int p = 0; p < points.law.count; ++p) {
      const Eigen::Vector2d rho = points.frame(p).transpose() * motion[p];
      points.law.gap.segment(m * p, m) =
          Eigen::Vector2d(gap[p] - rho.x(), slid[p] - rho.y()).head(m);
    }
  }
  return points;
}

Eigen::VectorXd contact_reactions(const Problem& problem, const StressField& stress) {
  const ControlPoints points = control_points(problem);
  const Eigen::Matrix2Xd force = nodal_forces(problem, stress).sum - nodal_loads(problem);
  const int m = points.law.components;
  Eigen::VectorXd F(points.law.size());
  for (int p = 0; p < points.law.count; ++p) {
    F.segment(m * p, m) = (points.frame(p).transpose() * force.col(points.node[p])).head(m);
    if (m == 2 && points.on_roller[p]) F(2 * p + 1) = 0;
  }
  return F;
}

}  // namespace airybench
