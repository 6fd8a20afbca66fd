#include "assembly/flexibility.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace airybench {
namespace {

// Pattern of the lower triangle by blocks: node j's columns hold its own triangle, then the
// unknowns of each later neighbour.
struct BlockPattern {
  std::vector<int> first, size;  // per node: first unknown, count (0: gauge)
  std::vector<int> start;        // per node: range in `later` and `offset`
  std::vector<int> later;        // neighbours later in the numbering, in that order
  std::vector<int> offset;       // unknowns of the later neighbours before this one
  std::vector<int> below;        // per node: unknowns of all later neighbours
};

BlockPattern block_pattern(const Problem& problem, const DofNumbering& dofs, const NodeGraph& graph,
                           const std::vector<int>& position) {
  const int nodes = static_cast<int>(position.size());
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  BlockPattern p;
  p.first.resize(nodes);
  p.size.resize(nodes);
  for (int i = 0; i < nodes; ++i) {
    p.first[i] = i < vertices ? dofs.of_vertex[i] : dofs.of_edge[i - vertices];
    p.size[i] = p.first[i] == DofNumbering::gauge ? 0 : (i < vertices ? 3 : 1);
  }
  p.start.assign(1, 0);
  p.start.reserve(nodes + 1);
  p.later.reserve(graph.neighbour.size() / 2);
  p.offset.reserve(graph.neighbour.size() / 2);
  p.below.resize(nodes);
  for (int i = 0; i < nodes; ++i) {
    for (int k = graph.start[i]; k < graph.start[i + 1]; ++k)
      if (position[graph.neighbour[k]] > position[i]) p.later.push_back(graph.neighbour[k]);
    std::sort(p.later.begin() + p.start[i], p.later.end(),
              [&](int a, int b) { return position[a] < position[b]; });
    int unknowns = 0;
    for (std::size_t k = p.start[i]; k < p.later.size(); ++k) {
      p.offset.push_back(unknowns);
      unknowns += p.size[p.later[k]];
    }
    p.below[i] = unknowns;
    p.start.push_back(static_cast<int>(p.later.size()));
  }
  return p;
}

Eigen::SparseMatrix<double> lay_out(const BlockPattern& p, int n) {
  Eigen::SparseMatrix<double> S(n, n);
  std::vector<int> node_at_column(n);
  for (int i = 0; i < static_cast<int>(p.first.size()); ++i)
    for (int c = 0; c < p.size[i]; ++c) node_at_column[p.first[i] + c] = i;
  int* outer = S.outerIndexPtr();
  outer[0] = 0;
  for (int j = 0; j < n; ++j) {
    const int node = node_at_column[j];
    outer[j + 1] = outer[j] + (p.first[node] + p.size[node] - j) + p.below[node];
  }
  S.resizeNonZeros(outer[n]);
  for (int j = 0; j < n; ++j) {
    const int node = node_at_column[j];
    int* row = S.innerIndexPtr() + outer[j];
    for (int i = j; i < p.first[node] + p.size[node]; ++i) *row++ = i;
    for (int k = p.start[node]; k < p.start[node + 1]; ++k)
      for (int r = 0; r < p.size[p.later[k]]; ++r) *row++ = p.first[p.later[k]] + r;
  }
  std::fill_n(S.valuePtr(), outer[n], 0.0);
  return S;
}

// Row offset of node `high` in node `low`'s columns, after its own triangle.
int offset_of(const BlockPattern& p, int low, int high) {
  for (int k = p.start[low];; ++k)
    if (p.later[k] == high) return p.offset[k];
}

}  // namespace

Eigen::SparseMatrix<double> assemble_flexibility(const Problem& problem, const DofNumbering& dofs,
                                                 const NodeGraph& graph,
                                                 const std::vector<int>& node_position) {
  const BlockPattern p = block_pattern(problem, dofs, graph, node_position);
  Eigen::SparseMatrix<double> S = lay_out(p, dofs.count);
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  constexpr int element_row[6] = {0, 3, 6, 9, 10, 11};  // first unknown of every local node

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const HctFlexibility s =
        hct_flexibility(hct_stress(problem.vertices_of(t), problem.edge_signs(t)),
                        problem.area_mm2(t), problem.compliance_of(t));
    const auto& v = problem.mesh.triangles[t];
    const auto& e = problem.edges.of_triangle[t];
    const int node[6] = {v[0], v[1], v[2], vertices + e[0], vertices + e[1], vertices + e[2]};
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 6; ++b) {
        if (node_position[node[b]] < node_position[node[a]]) continue;
        const int columns = p.size[node[a]], rows = p.size[node[b]];
        if (columns == 0 || rows == 0) continue;
        const int offset = a == b ? 0 : offset_of(p, node[a], node[b]);
        for (int c = 0; c < columns; ++c) {
          double* column = S.valuePtr() + S.outerIndexPtr()[p.first[node[a]] + c];
          double* to = a == b ? column - c : column + columns - c + offset;
          for (int r = a == b ? c : 0; r < rows; ++r)
            to[r] += s(element_row[b] + r, element_row[a] + c);
        }
      }
    }
  }
  return S;
}

Eigen::VectorXd equilibrate(Eigen::SparseMatrix<double>& S) {
  Eigen::VectorXd scale(S.rows());
  for (Eigen::Index j = 0; j < S.cols(); ++j) {
    const double diagonal = S.valuePtr()[S.outerIndexPtr()[j]];
    if (!(diagonal > 0) || !std::isfinite(diagonal))
      throw std::domain_error("S: diagonal entry " + std::to_string(j) + " is " +
                              std::to_string(diagonal) + "; it must be positive and finite");
    scale(j) = 1 / std::sqrt(diagonal);
  }
  for (Eigen::Index j = 0; j < S.cols(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(S, j); entry; ++entry)
      entry.valueRef() = entry.row() == j ? 1 : entry.value() * scale(j) * scale(entry.row());
  return scale;
}

}  // namespace airybench
