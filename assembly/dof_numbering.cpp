#include "assembly/dof_numbering.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>

namespace airybench {

std::array<int, 12> DofNumbering::of_triangle(const Problem& problem, int triangle) const {
  std::array<int, 12> dofs;
  for (int i = 0; i < 3; ++i) {
    const int phi = of_vertex[problem.mesh.triangles[triangle][i]];
    for (int k = 0; k < 3; ++k) dofs[3 * i + k] = phi == gauge ? gauge : phi + k;
    dofs[9 + i] = of_edge[problem.edges.of_triangle[triangle][i]];
  }
  return dofs;
}

std::array<int, 7> DofNumbering::of_edge_walk(int a, int b, int edge) const {
  std::array<int, 7> dofs;
  for (int k = 0; k < 3; ++k) {
    dofs[k] = of_vertex[a] == gauge ? gauge : of_vertex[a] + k;
    dofs[3 + k] = of_vertex[b] == gauge ? gauge : of_vertex[b] + k;
  }
  dofs[6] = of_edge[edge];
  return dofs;
}

NodeGraph airy_node_graph(const Problem& problem) {
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  const int nodes = vertices + problem.edges.count();
  const int triangles = static_cast<int>(problem.mesh.triangles.size());
  const auto nodes_of = [&](int t) {
    const auto& v = problem.mesh.triangles[t];
    const auto& e = problem.edges.of_triangle[t];
    return std::array{v[0], v[1], v[2], vertices + e[0], vertices + e[1], vertices + e[2]};
  };

  std::vector<int> triangle_start(nodes + 1, 0);
  for (int t = 0; t < triangles; ++t)
    for (const int node : nodes_of(t)) ++triangle_start[node + 1];
  for (int i = 0; i < nodes; ++i) triangle_start[i + 1] += triangle_start[i];
  std::vector<int> triangle_of(triangle_start.back()), fill(triangle_start);
  for (int t = 0; t < triangles; ++t)
    for (const int node : nodes_of(t)) triangle_of[fill[node]++] = t;

  NodeGraph graph;
  graph.start.reserve(nodes + 1);
  graph.start.push_back(0);
  // A vertex with k triangles has about 3k neighbours, an edge of two triangles 8.
  graph.neighbour.reserve(9 * triangles + 8 * problem.edges.count());
  std::vector<int> near;
  for (int i = 0; i < nodes; ++i) {
    near.clear();
    for (int k = triangle_start[i]; k < triangle_start[i + 1]; ++k)
      for (const int node : nodes_of(triangle_of[k]))
        if (node != i) near.push_back(node);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    graph.neighbour.insert(graph.neighbour.end(), near.begin(), near.end());
    graph.start.push_back(static_cast<int>(graph.neighbour.size()));
  }
  return graph;
}

std::vector<int> cuthill_mckee(const NodeGraph& graph) {
  using Graph =
      boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                         boost::no_property, int, int>;
  const int nodes = static_cast<int>(graph.start.size()) - 1;
  std::vector<std::pair<int, int>> arcs;
  arcs.reserve(graph.neighbour.size());
  for (int i = 0; i < nodes; ++i)
    for (int k = graph.start[i]; k < graph.start[i + 1]; ++k)
      arcs.emplace_back(i, graph.neighbour[k]);
  const Graph g(boost::edges_are_sorted, arcs.begin(), arcs.end(), nodes,
                static_cast<int>(arcs.size()));
  std::vector<std::pair<int, int>>().swap(arcs);

  std::vector<int> order(nodes);
  std::vector<boost::default_color_type> colour(nodes);
  const auto index = boost::get(boost::vertex_index, g);
  boost::cuthill_mckee_ordering(g, order.rbegin(),
                                boost::make_iterator_property_map(colour.begin(), index),
                                boost::make_out_degree_map(g));
  std::vector<int> position(nodes);
  for (int i = 0; i < nodes; ++i) position[order[i]] = i;
  return position;
}

DofNumbering number_dofs(const Problem& problem, const std::vector<int>& node_position) {
  const int vertices = static_cast<int>(problem.mesh.vertices.size());
  const int nodes = static_cast<int>(node_position.size());
  std::vector<int> node_at(nodes);
  for (int i = 0; i < nodes; ++i) node_at[node_position[i]] = i;

  DofNumbering dofs;
  dofs.of_vertex.resize(vertices);
  dofs.of_edge.resize(nodes - vertices);
  for (const int node : node_at) {
    if (std::ranges::count(problem.central_vertices, node) > 0) {
      dofs.of_vertex[node] = DofNumbering::gauge;
    } else if (node < vertices) {
      dofs.of_vertex[node] = dofs.count;
      dofs.count += 3;
    } else {
      dofs.of_edge[node - vertices] = dofs.count++;
    }
  }
  return dofs;
}

}  // namespace airybench
