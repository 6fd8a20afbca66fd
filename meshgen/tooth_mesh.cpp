#include "meshgen/tooth_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/vertex_search.hpp"

namespace airybench {
namespace {

// The integral of 1 / (√3/4 h²), which is that of G dy around the body, where G' = 1 / (√3/4 h²).
double count_triangles(const BoundaryPolygon& polygon, const SizeField& size) {
  const double length = size.x_c - size.x_d, growth = -2 * std::log(size.h_c / size.h_d),
               at_d = 4 / std::sqrt(3) / (size.h_d * size.h_d);
  const auto G = [&](double x) {
    const double part = (x - size.x_d) / length;
    return at_d * length * (std::abs(growth) < 1e-6 ? part : std::expm1(growth * part) / growth);
  };
  double triangles = 0;
  for (std::size_t k = 0; k < polygon.vertices.size(); ++k) {
    const Eigen::Vector2d &a = polygon.vertices[k],
                          &b = polygon.vertices[(k + 1) % polygon.vertices.size()];
    triangles += G((a.x() + b.x()) / 2) * (b.y() - a.y());
  }
  return triangles;
}

}  // namespace

Mesh tooth_mesh(const ToothDimensions& dimensions, const EdgeCounts& edges,
                std::optional<int> vertices, const std::string& name) {
  const BoundaryPolygon polygon = boundary_polygon(dimensions, edges);
  const SizeField size = size_field(dimensions, edges);
  constexpr double max_triangles = 2e7;
  if (const double triangles = count_triangles(polygon, size); triangles > max_triangles)
    throw std::invalid_argument(fmt::format(
        "about {:.1g} triangles with so many edges on tips and held face (allowed: up to {:g})",
        triangles, max_triangles));
  const auto mesher = [&](const InteriorRecipe& recipe) {
    return mesh_interior(polygon, size, recipe, name);
  };
  if (vertices && *vertices < edges.total())
    throw std::invalid_argument(fmt::format("vertices: {}; the {} boundary edges need at least {}",
                                            *vertices, edges.total(), edges.total()));
  Mesh mesh = vertices ? search_vertex_count(mesher, *vertices) : mesher({});
  validate(mesh);
  return mesh;
}

}  // namespace airybench
