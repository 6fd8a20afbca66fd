// Numbering of the Airy unknowns: Cuthill–McKee on the graph of vertices and edges, gauge removed.
//
// The nodes of the graph are the mesh's vertices (three unknowns φ, φ,x, φ,y) and edges (one,
// ∂φ/∂n); two are joined if they share a triangle. Reverse Cuthill–McKee from a pseudo-peripheral
// node orders the nodes; the unknowns of a node are consecutive. Affine φ carries no stress, so S
// has a 3-dimensional kernel per body. The gauge φ = φ,x = φ,y = 0 at one vertex of each removes
// it; these three have no number.
#pragma once

#include <array>
#include <vector>

#include "assembly/problem/problem.hpp"

namespace airybench {

struct DofNumbering {
  static constexpr int gauge = -1;
  std::vector<int> of_vertex;  // the number of φ; φ,x and φ,y follow. gauge: fixed to zero
  std::vector<int> of_edge;    // the number of ∂φ/∂n
  int count = 0;               // n_φ − 3 per body

  // An element's 12 unknowns in the order of hct.hpp, or gauge.
  std::array<int, 12> of_triangle(const Problem& problem, int triangle) const;
  // An edge's 7 unknowns in the order of edge_forces.hpp, for the walk a→b.
  std::array<int, 7> of_edge_walk(int a, int b, int edge) const;
};

// Nodes: vertices, then edges. Neighbours ascend and exclude the node.
struct NodeGraph {
  std::vector<int> start;      // nodes + 1
  std::vector<int> neighbour;  // of node i: start[i] … start[i+1]
};
NodeGraph airy_node_graph(const Problem& problem);

// Position of every node in reverse Cuthill–McKee order (E. Cuthill & J. McKee, 1969; A. George,
// 1971; Boost.Graph).
std::vector<int> cuthill_mckee(const NodeGraph& graph);

DofNumbering number_dofs(const Problem& problem, const std::vector<int>& node_position);

}  // namespace airybench
