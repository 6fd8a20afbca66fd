#include "solvers/condensation/edge_unknowns.hpp"

#include <algorithm>

#include "assembly/edge_forces.hpp"

namespace airybench {

std::vector<int> rows_in_frame(const Problem& problem) {
  std::vector<int> row_of_edge(static_cast<std::size_t>(problem.edges.count()), no_frame);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.condition(row).in_frame) row_of_edge[problem.edges.of_boundary[row]] = row;
  return row_of_edge;
}

int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown) {
  unknown.assign(static_cast<std::size_t>(problem.edges.count()), {0, 0, 0, 0});
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    auto& edge = unknown[problem.edges.of_boundary[row]];
    const EdgeCondition condition = problem.condition(row);
    for (int k = 0; k < 2; ++k)
      if (condition.component[k] == Known::displacement) edge[k] = edge[2 + k] = prescribed_unknown;
  }
  // Contact unknowns are marked by −2 − row until the inner ones are counted.
  for (int p = 0; p < contact.count; ++p) {
    auto& edge = unknown[problem.edges.of_boundary[contact.boundary[p]]];
    const int end = p % 2;  // points come in pairs: start and end of an edge
    for (int k = 0; k < contact.components; ++k)
      edge[2 * end + k] = -2 - (contact.components * p + k);
  }
  int inner = 0;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number == 0) number = inner++;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number <= -2) number = inner + (-2 - number);
  return inner;
}

std::vector<Eigen::Vector4d> prescribed_displacements(const Problem& problem) {
  std::vector<Eigen::Vector4d> displacement;
  if (!problem.loads.displacement_mm) return displacement;
  const Mesh& mesh = problem.mesh;
  displacement.assign(static_cast<std::size_t>(problem.edges.count()), Eigen::Vector4d::Zero());
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const auto [a, b] = mesh.boundary[row].vertices;
    const auto [start, end] = problem.prescribed_moments(row);
    auto& own = displacement[problem.edges.of_boundary[row]];
    if (problem.is_roller(row)) {
      const Eigen::Vector2d n = edge_frame(mesh.vertices[a], mesh.vertices[b]).normal;
      own << n.dot(start), 0, n.dot(end), 0;
    } else if (a < b) {
      own << start, end;
    } else {
      own << end, start;
    }
  }
  return displacement;
}

Eigen::Matrix4Xd edge_moments(const Problem& problem, const EdgeUnknowns& unknown,
                              const std::vector<Eigen::Vector4d>& prescribed,
                              const Eigen::VectorXd& u) {
  Eigen::Matrix4Xd moments = Eigen::Matrix4Xd::Zero(4, problem.edges.count());
  for (int edge = 0; edge < problem.edges.count(); ++edge) {
    if (!prescribed.empty()) moments.col(edge) = prescribed[edge];
    for (int k = 0; k < 4; ++k)
      if (unknown[edge][k] != prescribed_unknown) moments(k, edge) = u(unknown[edge][k]);
  }
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (!problem.condition(row).in_frame) continue;
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    const EdgeFrame at_start = problem.frame_of_moment(row, 0),
                    at_end = problem.frame_of_moment(row, 1);
    auto own = moments.col(problem.edges.of_boundary[row]);
    const Eigen::Vector2d start = own(0) * at_start.normal + own(1) * at_start.tangent,
                          end = own(2) * at_end.normal + own(3) * at_end.tangent;
    own << (a < b ? start : end), (a < b ? end : start);
  }
  return moments;
}

std::array<int, 12> element_unknowns(const Problem& problem, const EdgeUnknowns& unknown, int t) {
  std::array<int, 12> numbers;
  for (int k = 0; k < 3; ++k)
    std::copy_n(unknown[problem.edges.of_triangle[t][k]].begin(), 4, numbers.begin() + 4 * k);
  return numbers;
}

}  // namespace airybench
