#include "mesh/refinement.hpp"

#include "mesh/bisection.hpp"

namespace airybench {

Mesh uniformly_refined(const Mesh& mesh) {
  const MeshEdges edges = number_edges(mesh);
  const int vertices = static_cast<int>(mesh.vertices.size());
  Mesh fine;
  fine.name = mesh.name;
  fine.body_names = mesh.body_names;
  fine.boundary_groups = mesh.boundary_groups;
  fine.is_polygon = mesh.is_polygon;
  fine.vertices.reserve(mesh.vertices.size() + edges.vertices.size());
  fine.vertices = mesh.vertices;
  for (const auto& [a, b] : edges.vertices)
    fine.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    fine.vertices[vertices + edges.of_boundary[row]] = point_on(mesh, mesh.boundary[row], 0.5);
  fine.triangles.reserve(4 * mesh.triangles.size());
  fine.triangle_body.reserve(4 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const int ab = vertices + edges.of_triangle[t][0], bc = vertices + edges.of_triangle[t][1],
              ca = vertices + edges.of_triangle[t][2];
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    fine.triangle_body.insert(fine.triangle_body.end(), 4, mesh.triangle_body[t]);
  }
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    BoundaryEdge first = mesh.boundary[row];
    const BoundaryEdge second = cut_at(first, vertices + edges.of_boundary[row], 0.5);
    fine.boundary.insert(fine.boundary.end(), {first, second});
  }
  return with_fitting_curves(std::move(fine));
}

void split_at_point(Mesh& mesh, int triangle, int k, const Eigen::Vector2d& p) {
  const auto corners = mesh.triangles[triangle];
  const int a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
  const int inner = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(p);
  mesh.triangles[triangle] = {a, b, inner};
  mesh.triangles.push_back({b, c, inner});
  mesh.triangles.push_back({c, a, inner});
  mesh.triangle_body.insert(mesh.triangle_body.end(), 2, mesh.triangle_body[triangle]);
}

}  // namespace airybench
