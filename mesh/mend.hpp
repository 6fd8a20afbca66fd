// What a mesh file does not say of its body.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

// Gives a valid mesh of a file what the file has lost: straight sides their straightness
// (straight_sides.hpp), circles their arcs (arcs.hpp), and triangles that fit their curved edges
// (bisection.hpp). Returns a line for each that changed it, and for each of a boundary's groups
// that is curved or looks so (supposed_curves.hpp). Throws MeshError where a curve of the file
// cannot be that of its edge.
std::vector<std::string> mend(Mesh& mesh, double mm_per_unit = 1);

}  // namespace airybench
