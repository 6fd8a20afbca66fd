// The edges inside a mesh between two of its bodies.
#pragma once

#include <array>
#include <vector>

#include "mesh/boundary_sides.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

struct Interface {
  std::array<int, 2> bodies;  // rows of Mesh::body_names, ascending
  // Its edges as a boundary, with the first body on their left, and their vertices; no triangles.
  Mesh line;
  std::vector<std::array<TriangleSide, 2>> sides;  // per edge, of the first and of the second body
};

// One per pair of bodies. Edges at a vertex where a pair's interface branches are left out.
std::vector<Interface> interfaces(const Mesh& mesh, const MeshEdges& edges);

}  // namespace airybench
