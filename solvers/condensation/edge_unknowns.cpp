#include "solvers/condensation/edge_unknowns.hpp"

#include "assembly/elements/edge_forces.hpp"

namespace airybench {

std::vector<int> rows_in_frame(const Problem& problem) {
  std::vector<int> row_of_edge(static_cast<std::size_t>(problem.edges.count()), no_frame);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.condition(row).in_frame) row_of_edge[problem.edges.of_boundary[row]] = row;
  return row_of_edge;
}

int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown) {
  const int moments = contact.per_edge;
  unknown = EdgeUnknowns(static_cast<std::size_t>(problem.edges.count()), 2 * moments, 0);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    const std::span<int> edge = unknown[problem.edges.of_boundary[row]];
    const EdgeCondition condition = problem.condition(row);
    for (int k = 0; k < 2; ++k)
      if (condition.component[k] == Known::displacement)
        for (int j = 0; j < moments; ++j) edge[2 * j + k] = prescribed_unknown;
  }
  for (const auto& [row, component] : problem.free.pins) {
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    const int first = a < b ? 0 : moments - 1;  // from the low vertex on
    unknown[problem.edges.of_boundary[row]][2 * first + component] = prescribed_unknown;
  }
  // Contact unknowns are marked by −2 − row until the inner ones are counted.
  for (int p = 0; p < contact.count; ++p) {
    const std::span<int> edge = unknown[problem.edges.of_boundary[contact.boundary[p]]];
    for (int k = 0; k < contact.components; ++k)
      edge[2 * (p % moments) + k] = -2 - (contact.components * p + k);
  }
  int inner = 0;
  for (int& number : unknown.entries())
    if (number == 0) number = inner++;
  for (int& number : unknown.entries())
    if (number <= -2) number = inner + (-2 - number);
  return inner;
}

Eigen::MatrixXd prescribed_displacements(const Problem& problem, int degree) {
  if (!problem.loads.displacement_mm) return {};
  const Mesh& mesh = problem.mesh;
  Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(2 * (degree + 1), problem.edges.count());
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const auto [a, b] = mesh.boundary[row].vertices;
    EdgeMoments moments = problem.prescribed_moments(row, degree);
    if (problem.is_roller(row)) {
      for (int j = 0; j <= degree; ++j)
        moments(0, j) = problem.frame_of_moment(row, degree, j).normal.dot(moments.col(j));
      moments.row(1).setZero();
    } else if (a > b) {
      moments = moments.rowwise().reverse().eval();
    }
    displacement.col(problem.edges.of_boundary[row]) = moments.reshaped();
  }
  return displacement;
}

Eigen::MatrixXd edge_moments(const Problem& problem, const EdgeUnknowns& unknown,
                             const Eigen::MatrixXd& prescribed, const Eigen::VectorXd& u) {
  Eigen::MatrixXd moments = prescribed;
  if (moments.cols() == 0) moments.setZero(unknown.length(), problem.edges.count());
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    for (int k = 0; k < unknown.length(); ++k)
      if (unknown[edge][k] != prescribed_unknown) moments(k, edge) = u(unknown[edge][k]);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (!problem.condition(row).in_frame) continue;
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    auto own = moments.col(problem.edges.of_boundary[row]).reshaped(2, unknown.length() / 2);
    const int degree = static_cast<int>(own.cols()) - 1;
    for (int j = 0; j <= degree; ++j) {
      const EdgeFrame frame = problem.frame_of_moment(row, degree, j);
      own.col(j) = (own(0, j) * frame.normal + own(1, j) * frame.tangent).eval();
    }
    if (a > b) own = own.rowwise().reverse().eval();
  }
  return moments;
}

Eigen::MatrixXd thermal_moments(const Problem& problem, int degree) {
  if (problem.loads.thermal.empty()) return {};
  const int triangles = static_cast<int>(problem.mesh.triangles.size()), n = 2 * (degree + 1);
  const std::vector<int> rows = rows_in_frame(problem);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, triangles);
  for (int t = 0; t < triangles; ++t) {
    if (!problem.is_warm(t)) continue;
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Vector2d centre = v.rowwise().mean();
    const auto u = [&](const Eigen::Vector2d& x) {
      return problem.thermal_strain(t).displacement(x, centre);
    };
    const std::optional<CurvedSides> curves = problem.curves_of(t, degree);
    for (int e = 0; e < 3; ++e) {
      const int edge = problem.edges.of_triangle[t][e], row = rows[edge];
      EdgeMoments moments = moments_along(v.col(e), v.col((e + 1) % 3),
                                          curves ? (*curves)[e] : SideCurve(), degree, u);
      if (row != no_frame) {
        for (int j = 0; j <= degree; ++j) {
          const EdgeFrame frame = problem.frame_of_moment(row, degree, j);
          moments.col(j) =
              Eigen::Vector2d(frame.normal.dot(moments.col(j)), frame.tangent.dot(moments.col(j)));
        }
      } else if (const auto& corner = problem.mesh.triangles[t]; corner[e] > corner[(e + 1) % 3]) {
        moments = moments.rowwise().reverse().eval();
      }
      all.block(n * e, t, n, 1) = moments.reshaped();
    }
  }
  return all;
}

void element_unknowns(const Problem& problem, const EdgeUnknowns& unknown, int t,
                      std::vector<int>& numbers) {
  numbers.clear();
  for (const int edge : problem.edges.of_triangle[t])
    numbers.insert(numbers.end(), unknown[edge].begin(), unknown[edge].end());
}

}  // namespace airybench
