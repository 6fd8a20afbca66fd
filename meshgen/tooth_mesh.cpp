#include "meshgen/tooth_mesh.hpp"

#include <fmt/format.h>

#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/vertex_search.hpp"

namespace airybench {

Mesh tooth_mesh(const ToothDimensions& dimensions, const EdgeCounts& edges,
                std::optional<int> vertices, const std::string& name) {
  const BoundaryPolygon polygon = boundary_polygon(dimensions, edges);
  const SizeField size = size_field(dimensions, edges);
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
