#include "mesh/boundary_sides.hpp"

namespace airybench {

std::vector<TriangleSide> boundary_sides(const MeshEdges& edges) {
  std::vector<TriangleSide> of_edge(edges.vertices.size()), sides;
  for (int t = 0; t < static_cast<int>(edges.of_triangle.size()); ++t)
    for (int k = 0; k < 3; ++k) of_edge[edges.of_triangle[t][k]] = {t, k};
  for (const int edge : edges.of_boundary) sides.push_back(of_edge[edge]);
  return sides;
}

}  // namespace airybench
