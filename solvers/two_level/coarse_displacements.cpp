#include "solvers/two_level/coarse_displacements.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/direct/dense_cholesky.hpp"

namespace airybench {
namespace {

constexpr int no_row = -1;
using Matrix2 = Eigen::Matrix2d;

// Slot end k of an edge from its own node and from the other one.
constexpr std::array<std::array<double, 2>, 2> weights_of(CoarseKind kind) {
  if (kind == CoarseKind::per_edge) return {{{1, 0}, {1, 0}}};
  return {{{2. / 3, 1. / 3}, {1. / 3, 2. / 3}}};
}

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

CoarseKind coarse_kind_for(const Problem& problem) {
  constexpr double nearly = 0.03;  // 1 − 2ν in plane strain: ν = 0.485
  for (const Eigen::Matrix3d& C : problem.compliance) {
    const double volume = C(0, 0) + C(1, 1) + 2 * C(0, 1), shear = C(0, 0) + C(1, 1) - 2 * C(0, 1);
    if (volume < nearly * shear) return CoarseKind::per_edge;
  }
  return CoarseKind::linear;
}

CoarseDisplacements::CoarseDisplacements(const Problem& problem, const ContactPoints& contact,
                                         const EdgeMatrix& K, CoarseKind kind)
    : kind_(kind) {
  const auto edges = static_cast<std::size_t>(problem.edges.count());
  block_nodes_.resize(edges);
  for (std::size_t edge = 0; edge < edges; ++edge)
    block_nodes_[K.block_of_edge[edge]] = kind == CoarseKind::linear
                                              ? problem.edges.vertices[edge]
                                              : std::array{K.block_of_edge[edge], no_node};
  const auto nodes = kind == CoarseKind::linear ? problem.mesh.vertices.size() : edges;
  frame_of_node_.assign(nodes, no_row);
  unknown_.assign(nodes, {0, 0});
  find_boundary_blocks(problem, K);
  choose_frames(problem);
  number_nodes(problem);
  for (BoundaryBlock& of : boundary_) fill_prolongation(of);
  for (int p = 0; p < contact.count; ++p) {
    const int block = K.block_of_edge[problem.edges.of_boundary[contact.boundary[p]]];
    const auto& of = boundary_[boundary_of_block_[block]].nodes;
    node_of_point_.push_back(kind == CoarseKind::linear ? of[p % 2] : of[0]);
  }
}

// One for every row of Mesh::boundary but those of Γ_F.
void CoarseDisplacements::find_boundary_blocks(const Problem& problem, const EdgeMatrix& K) {
  boundary_of_block_.assign(block_nodes_.size(), no_row);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role == BoundaryRole::force) continue;
    BoundaryBlock of;
    of.block = K.block_of_edge[problem.edges.of_boundary[row]];
    const EdgeCondition condition = problem.condition(row);
    of.nodes = block_nodes_[of.block];
    if (condition.in_frame && kind_ == CoarseKind::linear)
      of.nodes = problem.mesh.boundary[row].vertices;
    for (int end = 0; end < 2; ++end) {
      const EdgeFrame frame = problem.frame_of_moment(row, end);
      of.direction[2 * end] = condition.in_frame ? frame.normal : Eigen::Vector2d::UnitX();
      of.direction[2 * end + 1] = condition.in_frame ? frame.tangent : Eigen::Vector2d::UnitY();
      for (int k = 0; k < 2; ++k)
        of.held[2 * end + k] = condition.component[k] == Known::displacement;
    }
    boundary_of_block_[of.block] = static_cast<int>(boundary_.size());
    boundary_.push_back(of);
  }
}

void CoarseDisplacements::choose_frames(const Problem& problem) {
  for (int row = 0, of = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role == BoundaryRole::force) continue;
    const BoundaryBlock& block = boundary_[of++];
    if (!problem.condition(row).in_frame) continue;
    for (const int node : block.nodes) {
      if (node == no_node || frame_of_node_[node] != no_row) continue;
      frame_of_node_[node] = static_cast<int>(frame_.size());
      frame_.emplace_back() << block.direction[0], block.direction[1];
    }
  }
}

template <typename Visit>
void CoarseDisplacements::visit_components(int node, const Eigen::Vector2d& direction,
                                           Visit visit) const {
  constexpr double part = 0.3;  // neighbours on a round wall differ by less
  const int frame = frame_of_node_[node];
  const Eigen::Vector2d own =
      frame == no_row ? direction : Eigen::Vector2d(frame_[frame].transpose() * direction);
  for (int k = 0; k < 2; ++k)
    if (std::abs(own(k)) > part) visit(k);
}

void CoarseDisplacements::number_nodes(const Problem& problem) {
  constexpr int held = -1, last = -2;
  int of = 0;
  for (const BoundaryEdge& edge : problem.mesh.boundary) {
    if (edge.role == BoundaryRole::force) continue;
    const BoundaryBlock& block = boundary_[of++];
    for (const int node : block.nodes) {
      if (node == no_node) continue;
      if (edge.role == BoundaryRole::contact)
        for (int& number : unknown_[node])
          if (number != held) number = last;
      for (int i = 0; i < 4; ++i)
        if (block.held[i])
          visit_components(node, block.direction[i], [&](int k) { unknown_[node][k] = held; });
    }
  }
  for (const int which : {0, last}) {
    first_trailing_ = unknowns_;
    for (NodeUnknowns& numbers : unknown_)
      for (int& number : numbers)
        if (number == which) number = unknowns_++;
  }
}

void CoarseDisplacements::fill_prolongation(BoundaryBlock& of) const {
  const auto weights = weights_of(kind_);
  for (int i = 0; i < 4; ++i)
    for (int n = 0; n < 2; ++n) {
      if (of.nodes[n] == no_node) continue;
      const int frame = frame_of_node_[of.nodes[n]];
      const Eigen::Vector2d own =
          frame == no_row ? of.direction[i]
                          : Eigen::Vector2d(frame_[frame].transpose() * of.direction[i]);
      of.P.block<1, 2>(i, 2 * n) = weights[i / 2][n] * own.transpose();
    }
}

// Of an element: its slots from the components of three nodes.
Eigen::Matrix<double, 12, 6> CoarseDisplacements::prolongation(
    const Problem& problem, const EdgeMatrix& K, const HybridizedSystem& system, int t,
    const std::array<int, 3>& nodes) const {
  const auto weights = weights_of(kind_);
  Eigen::Matrix<double, 12, 6> P = Eigen::Matrix<double, 12, 6>::Zero();
  for (int e = 0; e < 3; ++e) {
    const int edge = problem.edges.of_triangle[t][e], block = K.block_of_edge[edge];
    const int of = boundary_of_block_[block];
    const auto& ends = of == no_row ? block_nodes_[block] : boundary_[of].nodes;
    for (int n = 0; n < 2; ++n) {
      if (ends[n] == no_node) continue;
      const auto column = 2 * (std::find(nodes.begin(), nodes.end(), ends[n]) - nodes.begin());
      const int frame = frame_of_node_[ends[n]];
      for (int end = 0; end < 2; ++end)
        P.block<2, 2>(4 * e + 2 * end, column) =
            of != no_row ? Matrix2(boundary_[of].P.block<2, 2>(2 * end, 2 * n))
                         : Matrix2(weights[end][n] *
                                   (frame == no_row ? Matrix2::Identity() : frame_[frame]));
    }
    for (int i = 0; i < 4; ++i)
      if (system.unknown[edge][i] == prescribed_unknown) P.row(4 * e + i).setZero();
  }
  return P;
}

ElementMatrices CoarseDisplacements::galerkin(const Problem& problem, const EdgeMatrix& K,
                                              const HybridizedSystem& system) const {
  ElementMatrices coarse;
  coarse.order = unknowns_;
  coarse.reserve(static_cast<std::size_t>(system.K.count()));
  for (int t = 0; t < system.K.count(); ++t) {
    std::array<int, 3> nodes = problem.mesh.triangles[t];
    if (kind_ == CoarseKind::per_edge)
      for (int e = 0; e < 3; ++e) nodes[e] = K.block_of_edge[problem.edges.of_triangle[t][e]];
    ElementMatrices::Unknowns unknown;
    unknown.fill(-1);
    for (int n = 0; n < 3; ++n)
      for (int k = 0; k < 2; ++k) unknown[2 * n + k] = unknown_[nodes[n]][k];
    if (std::ranges::max(unknown) < 0) continue;
    const Eigen::Matrix<double, 12, 6> P = prolongation(problem, K, system, t, nodes);
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
  for (BoundaryBlock& of : boundary_) {
    const auto found = held.find(of.block);
    of.held = found == held.end() ? std::array<bool, 4>{} : found->second;
    for (int i = 0; i < 4; ++i) {
      if (!of.held[i]) continue;
      for (const int node : of.nodes)
        if (node != no_node)
          visit_components(node, of.direction[i], [&](int k) {
            const int trailing = unknown_[node][k] - first_trailing_;
            if (trailing >= 0) free[trailing] = false;
          });
    }
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
  const auto weights = weights_of(kind_);
  Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t block = 0; block < block_nodes_.size(); ++block) {
    if (boundary_of_block_[block] != no_row) continue;
    const auto at = 4 * static_cast<Eigen::Index>(block);
    for (int n = 0; n < 2; ++n)
      if (const int node = block_nodes_[block][n]; node != no_node)
        force.col(node) += weights[0][n] * r.segment<2>(at) + weights[1][n] * r.segment<2>(at + 2);
  }
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    if (frame_of_node_[node] != no_row)
      force.col(static_cast<Eigen::Index>(node)) =
          (frame_[frame_of_node_[node]].transpose() * force.col(static_cast<Eigen::Index>(node)))
              .eval();
  for (const BoundaryBlock& of : boundary_)
    for (int i = 0; i < 4; ++i) {
      if (of.held[i]) continue;
      for (int n = 0; n < 2; ++n)
        if (of.nodes[n] != no_node)
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
  const auto weights = weights_of(kind_);
  Eigen::Matrix2Xd at_node = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    for (int k = 0; k < 2; ++k)
      if (unknown_[node][k] >= 0)
        at_node(k, static_cast<Eigen::Index>(node)) = v(unknown_[node][k]);
  for (const BoundaryBlock& of : boundary_)
    for (int i = 0; i < 4; ++i) {
      if (of.held[i]) continue;
      for (int n = 0; n < 2; ++n)
        if (of.nodes[n] != no_node)
          x(4 * static_cast<Eigen::Index>(of.block) + i) +=
              of.P.block<1, 2>(i, 2 * n).dot(at_node.col(of.nodes[n]));
    }
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    if (frame_of_node_[node] != no_row)
      at_node.col(static_cast<Eigen::Index>(node)) =
          (frame_[frame_of_node_[node]] * at_node.col(static_cast<Eigen::Index>(node))).eval();
  for (std::size_t block = 0; block < block_nodes_.size(); ++block) {
    if (boundary_of_block_[block] != no_row) continue;
    const auto at = 4 * static_cast<Eigen::Index>(block);
    for (int n = 0; n < 2; ++n)
      if (const int node = block_nodes_[block][n]; node != no_node) {
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
  constexpr int most_points = 700;
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
  const int in_group = 1 + (static_cast<int>(met.size()) - 1) / most_points;
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
         block_nodes_.size() * (sizeof(block_nodes_[0]) + sizeof(int)) +
         boundary_.size() * sizeof(BoundaryBlock);
}

}  // namespace airybench
