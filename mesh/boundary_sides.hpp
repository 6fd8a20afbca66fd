// Which side of which triangle each edge of the boundary is.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

struct TriangleSide {
  int triangle = 0, k = 0;  // k: from the triangle's vertex k to the next
};

// Per row of Mesh::boundary.
std::vector<TriangleSide> boundary_sides(const MeshEdges& edges);

}  // namespace airybench
