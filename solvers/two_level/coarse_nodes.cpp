#include "solvers/two_level/coarse_nodes.hpp"

#include <algorithm>

namespace airybench {

CoarseKind coarse_kind_for(const Problem& problem) {
  constexpr double nearly = 0.03;  // 1 − 2ν in plane strain: ν = 0.485
  for (const Eigen::Matrix3d& C : problem.compliance) {
    const double volume = C(0, 0) + C(1, 1) + 2 * C(0, 1), shear = C(0, 0) + C(1, 1) - 2 * C(0, 1);
    if (volume < nearly * shear) return CoarseKind::per_edge;
  }
  return CoarseKind::linear;
}

CoarseNodes::CoarseNodes(const Problem& problem, CoarseKind of_kind,
                         const std::vector<int>& block_of_edge)
    : kind(of_kind) {
  find_blocks(problem, block_of_edge);
  choose_frames(problem);
  fill_prolongations();
}

CoarseNodes::CoarseNodes(const Problem& part, const CoarseNodes& whole,
                         const std::vector<int>& node_there, const std::vector<int>& block_of_edge)
    : kind(whole.kind), frame(whole.frame) {
  find_blocks(part, block_of_edge);
  for (std::size_t node = 0; node < node_there.size(); ++node)
    if (node_there[node] != none) frame_of_node[node] = whole.frame_of_node[node_there[node]];
  fill_prolongations();
}

void CoarseNodes::find_blocks(const Problem& problem, const std::vector<int>& block_of_edge) {
  const auto edges = static_cast<std::size_t>(problem.edges.count());
  of_block.resize(edges);
  for (std::size_t edge = 0; edge < edges; ++edge)
    of_block[block_of_edge[edge]] = kind == CoarseKind::linear
                                        ? problem.edges.vertices[edge]
                                        : std::array{block_of_edge[edge], none};
  frame_of_node.assign(kind == CoarseKind::linear ? problem.mesh.vertices.size() : edges, none);
  boundary_of_block.assign(edges, none);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role == BoundaryRole::force) continue;
    BoundaryBlock of;
    of.block = block_of_edge[problem.edges.of_boundary[row]];
    const EdgeCondition condition = problem.condition(row);
    of.nodes = of_block[of.block];
    if (condition.in_frame && kind == CoarseKind::linear)
      of.nodes = problem.mesh.boundary[row].vertices;
    for (int end = 0; end < 2; ++end) {
      const EdgeFrame own = problem.frame_of_moment(row, 1, end);
      of.direction[2 * end] = condition.in_frame ? own.normal : Eigen::Vector2d::UnitX();
      of.direction[2 * end + 1] = condition.in_frame ? own.tangent : Eigen::Vector2d::UnitY();
      for (int k = 0; k < 2; ++k)
        of.held[2 * end + k] = condition.component[k] == Known::displacement;
    }
    boundary_of_block[of.block] = static_cast<int>(boundary.size());
    boundary.push_back(of);
  }
}

void CoarseNodes::choose_frames(const Problem& problem) {
  for (int row = 0, of = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role == BoundaryRole::force) continue;
    const BoundaryBlock& block = boundary[of++];
    if (!problem.condition(row).in_frame) continue;
    for (const int node : block.nodes) {
      if (node == none || frame_of_node[node] != none) continue;
      frame_of_node[node] = static_cast<int>(frame.size());
      frame.emplace_back() << block.direction[0], block.direction[1];
    }
  }
}

std::array<std::array<double, 2>, 2> CoarseNodes::weights() const {
  if (kind == CoarseKind::per_edge) return {{{1, 0}, {1, 0}}};
  return {{{2. / 3, 1. / 3}, {1. / 3, 2. / 3}}};
}

Eigen::Matrix2d CoarseNodes::frame_at(int node) const {
  if (frame_of_node[node] == none) return Eigen::Matrix2d::Identity();
  return frame[frame_of_node[node]];
}

Eigen::Vector2d CoarseNodes::in_frame(int node, const Eigen::Vector2d& direction) const {
  if (frame_of_node[node] == none) return direction;
  return frame[frame_of_node[node]].transpose() * direction;
}

void CoarseNodes::fill_prolongations() {
  for (BoundaryBlock& of : boundary)
    for (int i = 0; i < 4; ++i)
      for (int n = 0; n < 2; ++n)
        if (of.nodes[n] != none)
          of.P.block<1, 2>(i, 2 * n) =
              weights()[i / 2][n] * in_frame(of.nodes[n], of.direction[i]).transpose();
}

Eigen::Matrix4d CoarseNodes::prolongation(int block) const {
  if (const int of = boundary_of_block[block]; of != none) return boundary[of].P;
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  for (int n = 0; n < 2; ++n) {
    if (of_block[block][n] == none) continue;
    for (int end = 0; end < 2; ++end)
      P.block<2, 2>(2 * end, 2 * n) = weights()[end][n] * frame_at(of_block[block][n]);
  }
  return P;
}

Eigen::Matrix<double, 12, 6> CoarseNodes::prolongation(const Problem& problem,
                                                       const EdgeUnknowns& unknown,
                                                       const std::vector<int>& block_of_edge,
                                                       int triangle,
                                                       const std::array<int, 3>& nodes) const {
  Eigen::Matrix<double, 12, 6> P = Eigen::Matrix<double, 12, 6>::Zero();
  for (int e = 0; e < 3; ++e) {
    const int edge = problem.edges.of_triangle[triangle][e], block = block_of_edge[edge];
    const Eigen::Matrix4d of_edge = prolongation(block);
    for (int n = 0; n < 2; ++n)
      if (const int node = nodes_of(block)[n]; node != none)
        P.block<4, 2>(4 * e, 2 * (std::ranges::find(nodes, node) - nodes.begin())) =
            of_edge.middleCols<2>(2 * n);
    for (int i = 0; i < 4; ++i)
      if (unknown[edge][i] == prescribed_unknown) P.row(4 * e + i).setZero();
  }
  return P;
}

}  // namespace airybench
