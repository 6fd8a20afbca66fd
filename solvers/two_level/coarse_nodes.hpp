// Nodes of coarse displacements v of the hybridized system, and P, which takes them to edge moments
// (edge_forces.hpp), along the edge's frame where it has one:
//
//   linear    a node per vertex, continuous piecewise linear:  ū_a = (2v_a + v_b)/3
//   per_edge  a node per edge, constant on it:                 ū_a = ū_b = v
//
// The first is a third of the second's size; the second does not lock near incompressibility.
// Nodes on Γ_C and rollers have normal and tangential components.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "solvers/condensation/edge_unknowns.hpp"

namespace airybench {

enum class CoarseKind { linear, per_edge };

// per_edge where a body is nearly incompressible.
CoarseKind coarse_kind_for(const Problem& problem);

struct CoarseNodes {
  static constexpr int none = -1;
  // An edge whose slots are not all free, or along a frame.
  struct BoundaryBlock {
    int block;
    std::array<int, 2> nodes;                     // the second may be none
    std::array<Eigen::Vector2d, 4> direction;     // of its slots
    Eigen::Matrix4d P = Eigen::Matrix4d::Zero();  // slots × components of the two nodes
    std::array<bool, 4> held = {};                // at first the prescribed slots
  };

  CoarseKind kind;
  std::vector<std::array<int, 2>> of_block;  // nodes; the second may be none
  std::vector<int> boundary_of_block;        // row of `boundary`, or none
  std::vector<BoundaryBlock> boundary;       // of every row of Mesh::boundary but those of Γ_F
  std::vector<int> frame_of_node;            // row of `frame`, or none: x and y
  std::vector<Eigen::Matrix2d> frame;        // columns n, t

  // Blocks have the four slots of an edge each. Of a part of a body, whose nodes are so numbered in
  // the whole boundary (none: inside), the frames are those of the whole boundary.
  CoarseNodes(const Problem& problem, CoarseKind kind, const std::vector<int>& block_of_edge);
  CoarseNodes(const Problem& part, const CoarseNodes& boundary, const std::vector<int>& node_there,
              const std::vector<int>& block_of_edge);

  int count() const { return static_cast<int>(frame_of_node.size()); }
  // Of a slot of end k from the edge's own node and from the other one.
  std::array<std::array<double, 2>, 2> weights() const;
  Eigen::Matrix2d frame_at(int node) const;
  Eigen::Vector2d in_frame(int node, const Eigen::Vector2d& direction) const;
  const std::array<int, 2>& nodes_of(int block) const {
    const int of = boundary_of_block[block];
    return of == none ? of_block[block] : boundary[of].nodes;
  }
  // A block's slots from the components of its nodes.
  Eigen::Matrix4d prolongation(int block) const;
  // A triangle's slots from the components of its three nodes; zero where prescribed.
  Eigen::Matrix<double, 12, 6> prolongation(const Problem& problem, const EdgeUnknowns& unknown,
                                            const std::vector<int>& block_of_edge, int triangle,
                                            const std::array<int, 3>& nodes) const;
  // Calls visit(component) for those of a node that a direction has a part in.
  template <typename Visit>
  void visit_components(int node, const Eigen::Vector2d& direction, Visit visit) const {
    constexpr double part = 0.3;  // neighbours on a round wall differ by less
    const Eigen::Vector2d own = in_frame(node, direction);
    for (int k = 0; k < 2; ++k)
      if (std::abs(own(k)) > part) visit(k);
  }
  // Calls visit(node, component) for those that a block's held slots hold.
  template <typename Visit>
  void visit_held(const BoundaryBlock& of, const std::array<bool, 4>& held, Visit visit) const {
    for (int i = 0; i < 4; ++i) {
      if (!held[i]) continue;
      for (const int node : of.nodes)
        if (node != none) visit_components(node, of.direction[i], [&](int k) { visit(node, k); });
    }
  }

 private:
  void find_blocks(const Problem& problem, const std::vector<int>& block_of_edge);
  void choose_frames(const Problem& problem);
  void fill_prolongations();
};

}  // namespace airybench
