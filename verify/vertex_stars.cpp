#include "verify/vertex_stars.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "verify/positive_definite.hpp"

namespace airybench {

bool need_vertex_stars(const Problem& problem) {
  constexpr double most = 5;
  return std::ranges::any_of(problem.compliance,
                             [](const Eigen::Matrix3d& c) { return bulk_over_shear(c) > most; });
}

VertexStars::VertexStars(const Problem& problem, const DisplacementTriangle& element,
                         const CurvedTraces& traces, const Eigen::Matrix2Xd& own,
                         const std::vector<bool>& held)
    : problem_(problem),
      element_(element),
      own_(own),
      held_(held),
      order_(problem.mesh.vertices.size()),
      first_(problem.mesh.vertices.size() + 1, 0),
      triangle_(3 * problem.mesh.triangles.size()),
      number_(held.size(), -1) {
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](int v) {
    const Eigen::Vector2d& x = problem.mesh.vertices[v];
    return std::pair(x.x(), x.y());
  });
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  const int triangles = static_cast<int>(problem.mesh.triangles.size());
  const int outer = 2 * element.outer, inner = 2 * element.inner;
  K_.reserve(problem.mesh.triangles.size());
  for (int t = 0; t < triangles; ++t) {
    DisplacementTriangle::Stiffness K = element.stiffness(
        TriangleShape(problem.vertices_of(t)), elasticity[problem.mesh.triangle_body[t]]);
    if (const auto* curved = traces.of(t)) K = curved->of_traces(K);
    Eigen::MatrixXd& of_outer = K_.emplace_back(K.topLeftCorner(outer, outer));
    if (inner > 0) {
      Eigen::MatrixXd eliminated = K.bottomLeftCorner(inner, outer);
      // Else a sliver's inner coefficients stay as they are.
      if (solve_positive_definite(K.bottomRightCorner(inner, inner), eliminated))
        of_outer -= K.topRightCorner(outer, inner).lazyProduct(eliminated);
    }
    for (const int v : problem.mesh.triangles[t]) ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int t = 0; t < triangles; ++t)
    for (const int v : problem.mesh.triangles[t]) triangle_[next[v]++] = t;
}

void VertexStars::sweep(DisplacementField& w) {
  for (const int v : order_) improve(v, w);
}

void VertexStars::improve(int vertex, DisplacementField& w) {
  free_.clear();
  const auto add = [&](int node) {
    if (held_[static_cast<std::size_t>(node)] || number_[node] >= 0) return;
    number_[node] = static_cast<int>(free_.size());
    free_.push_back(node);
  };
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const auto nodes = triangle_nodes(problem_, element_.degree, triangle_[at]);
    const int corner =
        static_cast<int>(std::find(nodes.begin(), nodes.begin() + 3, vertex) - nodes.begin());
    add(vertex);
    for (const int edge : {corner, (corner + 2) % 3})
      for (int i = 1; i < element_.degree; ++i) add(nodes[element_.on_edge(edge, i)]);
  }
  const auto n = static_cast<Eigen::Index>(2 * free_.size());
  matrix_.assign(static_cast<std::size_t>(n * (n + 1)), 0);
  Eigen::Map<Eigen::MatrixXd> K(matrix_.data(), n, n);
  Eigen::Map<Eigen::VectorXd> r(matrix_.data() + n * n, n);
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const int t = triangle_[at];
    const auto nodes = triangle_nodes(problem_, element_.degree, t);
    DisplacementTriangle::Vector off(2 * element_.outer);
    for (int i = 0; i < element_.outer; ++i)
      off.segment<2>(2 * i) = own_.col(element_.nodes * t + i) - w.col(nodes[i]);
    for (int j = 0; j < element_.outer; ++j) {
      const int column = number_[nodes[j]];
      if (column < 0) continue;
      for (int x = 0; x < 2; ++x) r(2 * column + x) += K_[t].col(2 * j + x).dot(off);
      for (int i = 0; i < element_.outer; ++i)
        if (const int row = number_[nodes[i]]; row >= column)
          for (int x = 0; x < 2; ++x)
            for (int y = 0; y < 2; ++y)
              K(2 * row + y, 2 * column + x) += K_[t](2 * i + y, 2 * j + x);
    }
  }
  if (solve_positive_definite_in_place(K, r))  // else w stays
    for (std::size_t i = 0; i < free_.size(); ++i)
      w.col(free_[i]) += r.segment<2>(2 * static_cast<Eigen::Index>(i));
  for (const int node : free_) number_[node] = -1;
}

}  // namespace airybench
