#include "bench/verify/vertex_stars.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <utility>

#include "assembly/small_cholesky.hpp"

namespace airybench {

bool need_vertex_stars(const Problem& problem) {
  constexpr double most = 5;
  return std::ranges::any_of(problem.compliance,
                             [](const Eigen::Matrix3d& c) { return bulk_over_shear(c) > most; });
}

template <int k>
VertexStars<k>::VertexStars(const Problem& problem, const std::vector<OfTriangle>& own,
                            const std::vector<bool>& held)
    : problem_(problem),
      own_(own),
      held_(held),
      order_(problem.mesh.vertices.size()),
      first_(problem.mesh.vertices.size() + 1, 0),
      triangle_(3 * own.size()),
      number_(held.size(), -1) {
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](int v) {
    const Eigen::Vector2d& x = problem.mesh.vertices[v];
    return std::pair(x.x(), x.y());
  });
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  K_.reserve(own.size());
  for (int t = 0; t < static_cast<int>(own.size()); ++t) {
    const auto K = Triangle::stiffness(TriangleShape(problem.vertices_of(t)),
                                       elasticity[problem.mesh.triangle_body[t]]);
    Stiffness& of_outer = K_.emplace_back(K.template topLeftCorner<2 * outer, 2 * outer>());
    if constexpr (Triangle::inner > 0) {
      constexpr int inner = 2 * Triangle::inner;
      const SmallCholesky<double, inner> factor(
          Eigen::Matrix<double, inner, inner>(K.template bottomRightCorner<inner, inner>()));
      if (factor.last_pivot() > 0) {  // else a sliver's inner coefficients stay as they are
        Eigen::Matrix<double, inner, 2 * outer> root =
            K.template bottomLeftCorner<inner, 2 * outer>();
        factor.solve_lower(root);
        of_outer -= root.transpose() * root;
      }
    }
    for (const int v : problem.mesh.triangles[t]) ++first_[v + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int t = 0; t < static_cast<int>(own.size()); ++t)
    for (const int v : problem.mesh.triangles[t]) triangle_[next[v]++] = t;
}

template <int k>
void VertexStars<k>::sweep(DisplacementField& w) {
  for (const int v : order_) improve(v, w);
}

template <int k>
void VertexStars<k>::improve(int vertex, DisplacementField& w) {
  free_.clear();
  const auto add = [&](int node) {
    if (held_[static_cast<std::size_t>(node)] || number_[node] >= 0) return;
    number_[node] = static_cast<int>(free_.size());
    free_.push_back(node);
  };
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const auto nodes = triangle_nodes<k + 1>(problem_, triangle_[at]);
    const int corner =
        static_cast<int>(std::find(nodes.begin(), nodes.begin() + 3, vertex) - nodes.begin());
    add(vertex);
    for (const int edge : {corner, (corner + 2) % 3})
      for (int i = 1; i <= k; ++i) add(nodes[Triangle::on_edge(edge, i)]);
  }
  const auto n = static_cast<Eigen::Index>(2 * free_.size());
  matrix_.assign(static_cast<std::size_t>(n * (n + 1)), 0);
  Eigen::Map<Eigen::MatrixXd> K(matrix_.data(), n, n);
  Eigen::Map<Eigen::VectorXd> r(matrix_.data() + n * n, n);
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const int t = triangle_[at];
    const auto nodes = triangle_nodes<k + 1>(problem_, t);
    Eigen::Matrix<double, 2, outer> off;
    for (int i = 0; i < outer; ++i) off.col(i) = own_[t].col(i) - w.col(nodes[i]);
    for (int j = 0; j < outer; ++j) {
      const int column = number_[nodes[j]];
      if (column < 0) continue;
      const auto of_node = K_[t].template middleCols<2>(2 * j);
      r.segment<2>(2 * column) += of_node.transpose().lazyProduct(off.reshaped());
      for (int i = 0; i < outer; ++i)
        if (const int row = number_[nodes[i]]; row >= column)
          K.block<2, 2>(2 * row, 2 * column) += of_node.template middleRows<2>(2 * i);
    }
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(K);
  if (factor.info() == Eigen::Success) {  // else w stays
    factor.solveInPlace(r);
    for (std::size_t i = 0; i < free_.size(); ++i)
      w.col(free_[i]) += r.segment<2>(2 * static_cast<Eigen::Index>(i));
  }
  for (const int node : free_) number_[node] = -1;
}

#define AIRYBENCH_INSTANTIATE(k) template class VertexStars<k>;
AIRYBENCH_STRESS_DEGREES(AIRYBENCH_INSTANTIATE)
#undef AIRYBENCH_INSTANTIATE

}  // namespace airybench
