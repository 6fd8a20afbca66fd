// A mesh with a given number of vertices, by varying the inside.
//
// V(f), the vertex count over the size factor, falls with f but jumps and wavers by a few vertices.
// Per kind of mesh (algorithm, grading exponent): bracket and bisect ln f; should the bisection end
// on a jump across the target, look at factors around it. Every hit ends its kind.
#pragma once

#include <functional>

#include "mesh/mesh.hpp"
#include "meshgen/gmsh_mesher.hpp"

namespace airybench {

// The smallest angle at which the search is content and tries no further kind.
inline constexpr double good_angle_deg = 28;

// The first hit with a smallest angle of at least good_angle_deg, else the hit with the largest
// smallest angle. Throws MeshError with the nearest count when no kind hits.
Mesh search_vertex_count(const std::function<Mesh(const InteriorRecipe&)>& mesher, int vertices);

}  // namespace airybench
