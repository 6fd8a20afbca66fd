#include "solvers/two_level/coarse_displacements.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/direct/dense_factors.hpp"

namespace airybench {
namespace {

constexpr int none = CoarseNodes::none;

// Of L Lᵀ.
Eigen::MatrixXd lower_of_product(const Eigen::MatrixXd& L) {
  constexpr Eigen::Index width = 128;
  const Eigen::Index n = L.rows();
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; k += width)
    add_square(1, L.block(k, k, n - k, std::min(width, n - k)), S.bottomRightCorner(n - k, n - k));
  return S;
}

}  // namespace

CoarseDisplacements::CoarseDisplacements(const Problem& problem, const ContactPoints& contact,
                                         const EdgeMatrix& K, CoarseKind kind)
    : nodes_(problem, kind, K.block_of_edge) {
  unknown_.assign(static_cast<std::size_t>(nodes_.count()), {0, 0});
  number_nodes(problem);
  for (int p = 0; p < contact.count; ++p) {
    const int block = K.block_of_edge[problem.edges.of_boundary[contact.boundary[p]]];
    const std::array<int, 2>& of = nodes_.nodes_of(block);
    node_of_point_.push_back(kind == CoarseKind::linear ? of[p % 2] : of[0]);
  }
}

void CoarseDisplacements::number_nodes(const Problem& problem) {
  constexpr int held = -1, last = -2;
  int of = 0;
  for (const BoundaryEdge& edge : problem.mesh.boundary) {
    if (edge.role == BoundaryRole::force) continue;
    const CoarseNodes::BoundaryBlock& block = nodes_.boundary[of++];
    if (edge.role == BoundaryRole::contact)
      for (const int node : block.nodes)
        if (node != none)
          for (int& number : unknown_[node])
            if (number != held) number = last;
    nodes_.visit_held(block, block.held, [&](int node, int k) { unknown_[node][k] = held; });
  }
  for (const int which : {0, last}) {
    first_trailing_ = unknowns_;
    for (NodeUnknowns& numbers : unknown_)
      for (int& number : numbers)
        if (number == which) number = unknowns_++;
  }
}

ElementMatrices CoarseDisplacements::galerkin(const Problem& problem, const EdgeMatrix& K,
                                              const HybridizedSystem& system) const {
  ElementMatrices coarse;
  coarse.order = unknowns_;
  coarse.reserve(static_cast<std::size_t>(system.K.count()));
  for (int t = 0; t < system.K.count(); ++t) {
    std::array<int, 3> nodes = problem.mesh.triangles[t];
    if (kind() == CoarseKind::per_edge)
      for (int e = 0; e < 3; ++e) nodes[e] = K.block_of_edge[problem.edges.of_triangle[t][e]];
    ElementMatrices::Unknowns unknown;
    unknown.fill(-1);
    for (int n = 0; n < 3; ++n)
      for (int k = 0; k < 2; ++k) unknown[2 * n + k] = unknown_[nodes[n]][k];
    if (std::ranges::max(unknown) < 0) continue;
    const Eigen::Matrix<double, 12, 6> P =
        nodes_.prolongation(problem, system.unknown, K.block_of_edge, t, nodes);
    Eigen::Matrix<double, 12, 6> KP;
    for (int j = 0; j < 6; ++j) KP.col(j) = system.K.product(t, P.col(j));
    ElementMatrices::Matrix of_element = ElementMatrices::Matrix::Zero();
    of_element.topLeftCorner<6, 6>().noalias() = P.transpose() * KP;
    coarse.add(unknown, system.K.centre[t], of_element);
  }
  return coarse;
}

void CoarseDisplacements::factorise(const ElementMatrices& coarse, const Deadline& deadline,
                                    StageTimes& times) {
  constexpr std::int64_t cached = 4'000'000;  // entries of L: a solve reads all of them twice
  run_stage(times, Stage::order, MemoryOwner::factor,
            [&] { factor_.analyse(coarse, unknowns_ - first_trailing_); });
  deadline.check("the ordering of the coarse matrix");
  run_stage(times, Stage::factor, MemoryOwner::factor, [&] {
    if (factor_.entries() > cached)
      factor_.factor_rounded(coarse, deadline);
    else
      factor_.factor(coarse, deadline);
    const OwnerScope scope(MemoryOwner::preconditioner);
    S_ = lower_of_product(factor_.trailing_factor());
  });
}

void CoarseDisplacements::hold(const std::map<int, std::array<bool, 4>>& held) {
  std::vector<bool> free(static_cast<std::size_t>(S_.rows()), true);
  for (CoarseNodes::BoundaryBlock& of : nodes_.boundary) {
    const auto found = held.find(of.block);
    of.held = found == held.end() ? std::array<bool, 4>{} : found->second;
    nodes_.visit_held(of, of.held, [&](int node, int k) {
      const int trailing = unknown_[node][k] - first_trailing_;
      if (trailing >= 0) free[trailing] = false;
    });
  }
  std::vector<int> now;
  for (int i = 0; i < static_cast<int>(free.size()); ++i)
    if (free[i]) now.push_back(i);
  const bool all = now.size() == free.size();
  if (now != free_ && !all && !now.empty()) {
    const OwnerScope scope(MemoryOwner::preconditioner);
    on_free_factor_ = S_(now, now);
    if (!factorise_in_place(on_free_factor_))
      throw Breakdown("the coarse problem of the contact rows is not positive definite");
  }
  free_ = std::move(now);
}

Eigen::VectorXd CoarseDisplacements::restricted(const Eigen::VectorXd& r) const {
  const auto weights = nodes_.weights();
  Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t block = 0; block < nodes_.of_block.size(); ++block) {
    if (nodes_.boundary_of_block[block] != none) continue;
    const auto at = 4 * static_cast<Eigen::Index>(block);
    for (int n = 0; n < 2; ++n)
      if (const int node = nodes_.of_block[block][n]; node != none)
        force.col(node) += weights[0][n] * r.segment<2>(at) + weights[1][n] * r.segment<2>(at + 2);
  }
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    if (nodes_.frame_of_node[node] != none)
      force.col(static_cast<Eigen::Index>(node)) =
          (nodes_.frame[nodes_.frame_of_node[node]].transpose() *
           force.col(static_cast<Eigen::Index>(node)))
              .eval();
  for (const CoarseNodes::BoundaryBlock& of : nodes_.boundary)
    for (int i = 0; i < 4; ++i) {
      if (of.held[i]) continue;
      for (int n = 0; n < 2; ++n)
        if (of.nodes[n] != none)
          force.col(of.nodes[n]) += r(4 * static_cast<Eigen::Index>(of.block) + i) *
                                    of.P.block<1, 2>(i, 2 * n).transpose();
    }
  Eigen::VectorXd load(unknowns_);
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    for (int k = 0; k < 2; ++k)
      if (unknown_[node][k] >= 0)
        load(unknown_[node][k]) = force(k, static_cast<Eigen::Index>(node));
  return load;
}

void CoarseDisplacements::add_prolonged(const Eigen::VectorXd& v, Eigen::VectorXd& x) const {
  const auto weights = nodes_.weights();
  Eigen::Matrix2Xd at_node = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    for (int k = 0; k < 2; ++k)
      if (unknown_[node][k] >= 0)
        at_node(k, static_cast<Eigen::Index>(node)) = v(unknown_[node][k]);
  for (const CoarseNodes::BoundaryBlock& of : nodes_.boundary)
    for (int i = 0; i < 4; ++i) {
      if (of.held[i]) continue;
      for (int n = 0; n < 2; ++n)
        if (of.nodes[n] != none)
          x(4 * static_cast<Eigen::Index>(of.block) + i) +=
              of.P.block<1, 2>(i, 2 * n).dot(at_node.col(of.nodes[n]));
    }
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    if (nodes_.frame_of_node[node] != none)
      at_node.col(static_cast<Eigen::Index>(node)) =
          (nodes_.frame[nodes_.frame_of_node[node]] * at_node.col(static_cast<Eigen::Index>(node)))
              .eval();
  for (std::size_t block = 0; block < nodes_.of_block.size(); ++block) {
    if (nodes_.boundary_of_block[block] != none) continue;
    const auto at = 4 * static_cast<Eigen::Index>(block);
    for (int n = 0; n < 2; ++n)
      if (const int node = nodes_.of_block[block][n]; node != none) {
        x.segment<2>(at) += weights[0][n] * at_node.col(node);
        x.segment<2>(at + 2) += weights[1][n] * at_node.col(node);
      }
  }
}

void CoarseDisplacements::correct(const Eigen::VectorXd& r, Eigen::VectorXd& x) const {
  if (unknowns_ == 0) return;
  using Columns = MultifrontalFactor::Columns;
  const Eigen::Index trailing = S_.rows();
  const Columns columns =
      static_cast<Eigen::Index>(free_.size()) < trailing ? Columns::inner : Columns::all;
  Eigen::VectorXd y = factor_.forward(restricted(r), columns);
  if (columns == Columns::inner) {
    auto last = y.tail(trailing);
    Eigen::VectorXd u = last(free_);
    if (!free_.empty()) solve_by_cholesky(on_free_factor_, u);
    last.setZero();
    last(free_) = u;
  }
  add_prolonged(factor_.backward(y, columns), x);
}

CoarseContact CoarseDisplacements::contact_problem(const ContactPoints& contact,
                                                   const Eigen::VectorXd& b) const {
  constexpr int max_points = 700;
  const int m = contact.components;
  CoarseContact coarse;
  ContactPoints& points = coarse.problem.points;
  points.components = m;
  std::vector<int> place(unknown_.size(), -1), met;  // of nodes along Γ_C, as points meet them
  for (const int node : node_of_point_)
    if (place[node] < 0 && std::ranges::min(unknown_[node]) >= 0) {
      place[node] = static_cast<int>(met.size());
      met.push_back(node);
    }
  const int in_group = 1 + (static_cast<int>(met.size()) - 1) / max_points;
  points.count = (static_cast<int>(met.size()) + in_group - 1) / in_group;
  for (const int node : node_of_point_)
    coarse.of_point.push_back(place[node] < 0 ? -1 : place[node] / in_group);
  if (points.count == 0) return coarse;

  std::vector<double> nodes(static_cast<std::size_t>(points.count)), times = nodes;
  for (std::size_t i = 0; i < met.size(); ++i) ++nodes[i / in_group];
  for (const int point : coarse.of_point)
    if (point >= 0) ++times[point];
  if (m == 2) points.friction.assign(times.size(), 0);
  if (contact.gap.size() > 0) points.gap.setZero(points.size());
  for (int p = 0; p < contact.count; ++p) {
    const int point = coarse.of_point[p];
    if (point < 0) continue;
    if (m == 2) points.friction[point] += contact.friction_at(p) / times[point];
    if (contact.gap.size() > 0)
      points.gap.segment(m * point, m) += contact.gap.segment(m * p, m) / times[point];
  }
  // Columns: L⁻¹ N, N spreading a group's force evenly over its nodes.
  const Eigen::MatrixXd L = factor_.trailing_factor();
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(L.rows(), points.size());
  for (std::size_t i = 0; i < met.size(); ++i)
    for (int k = 0; k < m; ++k) {
      const auto group = static_cast<int>(i) / in_group;
      N(unknown_[met[i]][k] - first_trailing_, m * group + k) = 1 / nodes[group];
    }
  solve_lower(L, N);
  coarse.problem.D.setZero(N.cols(), N.cols());
  add_transposed_times(1, N, N, coarse.problem.D);
  coarse.problem.G = -transposed_times(N, factor_.forward(restricted(b)).tail(L.rows()));
  return coarse;
}

std::size_t CoarseDisplacements::bytes() const {
  return static_cast<std::size_t>(S_.size() + on_free_factor_.size()) * sizeof(double) +
         unknown_.size() * (sizeof(NodeUnknowns) + sizeof(int)) +
         nodes_.of_block.size() * (sizeof(nodes_.of_block[0]) + sizeof(int)) +
         nodes_.boundary.size() * sizeof(CoarseNodes::BoundaryBlock);
}

}  // namespace airybench
