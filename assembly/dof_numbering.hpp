// Numbering of the Airy unknowns: Cuthill–McKee on the graph of vertices and edges, gauge removed.
//
// The nodes of the graph are the mesh's vertices (three unknowns φ, φ,x, φ,y) and edges (one,
// ∂φ/∂n); two are joined when they share a triangle. Reverse Cuthill–McKee from a pseudo-peripheral
// node numbers the nodes, and each node's unknowns in a row.
//
// Affine φ carries no stress, so S has a 3-dimensional kernel. The gauge φ = φ,x = φ,y = 0 at one
// vertex removes it; these three are not numbered.
#pragma once

#include <array>
#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

struct DofNumbering {
  static constexpr int gauge = -1;
  std::vector<int> of_vertex;  // the number of φ; φ,x and φ,y follow. gauge: fixed to zero
  std::vector<int> of_edge;    // the number of ∂φ/∂n
  int count = 0;               // n_φ − 3

  // Numbers of an element's 12 unknowns in the order of hct.hpp, or gauge.
  std::array<int, 12> of_triangle(const Problem& problem, int triangle) const;
  // Numbers of an edge's 7 unknowns in the order of edge_forces.hpp, for the walk a→b.
  std::array<int, 7> of_edge_walk(int a, int b, int edge) const;
};

// The graph, by node: vertices first, then edges. Neighbours in increasing order, without the node.
struct NodeGraph {
  std::vector<int> start;      // nodes + 1
  std::vector<int> neighbour;  // of node i: start[i] … start[i+1]
};
NodeGraph airy_node_graph(const Problem& problem);

// Reverse Cuthill–McKee (E. Cuthill & J. McKee, 1969; A. George, 1971; Boost.Graph's): position of
// every node in the new order.
std::vector<int> cuthill_mckee(const NodeGraph& graph);

DofNumbering number_dofs(const Problem& problem, const std::vector<int>& node_position);

}  // namespace airybench
