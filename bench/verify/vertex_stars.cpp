#include "bench/verify/vertex_stars.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace airybench {

VertexStars::VertexStars(const Problem& problem, const std::vector<OfTriangle>& own,
                         const std::vector<bool>& held)
    : problem_(problem),
      own_(own),
      first_(problem.mesh.vertices.size() + 1, 0),
      triangle_(3 * own.size()),
      number_(held.size(), -1) {
  std::vector<Eigen::Matrix3d> elasticity;
  for (const Eigen::Matrix3d& compliance : problem.compliance)
    elasticity.push_back(elasticity_of(compliance));
  K_.reserve(own.size());
  for (int t = 0; t < static_cast<int>(own.size()); ++t) {
    const std::array<int, 6> nodes = triangle_nodes(problem, t);
    ElementMatrices::Unknowns unknown;
    for (int i = 0; i < 12; ++i)
      unknown[i] = held[static_cast<std::size_t>(nodes[i / 2])] ? -1 : 2 * nodes[i / 2] + i % 2;
    const TriangleVertices v = problem.vertices_of(t);
    K_.add(unknown, centre_of(v),
           quadratic_stiffness(quadratic_strain(v), problem.area_mm2(t),
                               elasticity[problem.mesh.triangle_body[t]]));
    for (int k = 0; k < 3; ++k) ++first_[nodes[k] + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int t = 0; t < static_cast<int>(own.size()); ++t)
    for (const int v : problem.mesh.triangles[t]) triangle_[next[v]++] = t;
}

void VertexStars::sweep(DisplacementField& w) {
  for (int v = 0; v + 1 < static_cast<int>(first_.size()); ++v) improve(v, w);
}

bool VertexStars::are_needed(const Problem& problem) {
  constexpr double most = 5;
  return std::ranges::any_of(problem.compliance, [](const Eigen::Matrix3d& c) {
    return c(2, 2) > most * 2 * (c(0, 0) + c(0, 1));  // bulk modulus > most × shear modulus
  });
}

void VertexStars::improve(int vertex, DisplacementField& w) {
  free_.clear();
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const int t = triangle_[at];
    const std::array<int, 6> nodes = triangle_nodes(problem_, t);
    for (int k = 0; k < 3; ++k)
      if (nodes[k] == vertex)
        for (const int i : {k, 3 + k, 3 + (k + 2) % 3})
          if (K_.unknown[t][2 * i] >= 0 && number_[nodes[i]] < 0) {
            number_[nodes[i]] = static_cast<int>(free_.size());
            free_.push_back(nodes[i]);
          }
  }
  const auto n = static_cast<Eigen::Index>(2 * free_.size());
  matrix_.assign(static_cast<std::size_t>(n * (n + 1)), 0);
  Eigen::Map<Eigen::MatrixXd> K(matrix_.data(), n, n);
  Eigen::Map<Eigen::VectorXd> r(matrix_.data() + n * n, n);
  for (int at = first_[vertex]; at < first_[vertex + 1]; ++at) {
    const int t = triangle_[at];
    const std::array<int, 6> nodes = triangle_nodes(problem_, t);
    std::array<int, 12> row;
    Eigen::Matrix<double, 12, 1> off;
    for (int i = 0; i < 12; ++i) {
      const int node = nodes[i / 2];
      row[i] = number_[node] < 0 ? -1 : 2 * number_[node] + i % 2;
      off(i) = own_[t](i % 2, i / 2) - w(i % 2, node);
    }
    const Eigen::Matrix<double, 12, 1> force = K_.product(t, off);
    const double* entry = K_.lower[t].data();
    for (int j = 0; j < 12; ++j) {
      if (row[j] >= 0) r(row[j]) += force(j);
      for (int i = j; i < 12; ++i, ++entry)
        if (row[i] >= 0 && row[j] >= 0)
          K(std::max(row[i], row[j]), std::min(row[i], row[j])) += *entry;
    }
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(K);
  if (factor.info() == Eigen::Success) {  // else w stays
    factor.solveInPlace(r);
    for (std::size_t k = 0; k < free_.size(); ++k)
      w.col(free_[k]) += r.segment<2>(2 * static_cast<Eigen::Index>(k));
  }
  for (const int node : free_) number_[node] = -1;
}

}  // namespace airybench
