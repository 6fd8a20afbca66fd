// Where a mesh is wrong, and probably why, for messages. Numbers are those of its file; a model's
// user knows places only.
#pragma once

#include <array>
#include <string>

#include "mesh/mesh.hpp"

namespace airybench {

// "vertex 7 at [1, 0.5]", "edge 3-7 at [1, 0.25]", at its middle; "triangle 4 at [0.3, 0.3]", at
// its centroid. Vertices must exist.
std::string vertex_text(const Mesh& mesh, int vertex);
std::string edge_text(const Mesh& mesh, int a, int b);
std::string triangle_text(const Mesh& mesh, int triangle);

// Why the boundary comes to a vertex twice.
std::string why_touching(const Mesh& mesh, int vertex);
// Why two edges of the boundary cross or touch.
std::string why_meeting(const Mesh& mesh, const std::array<int, 2>& one,
                        const std::array<int, 2>& other);

}  // namespace airybench
