// Finer meshes of the same body. New vertices are put behind the old ones; roles and bodies are
// inherited.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench {

// Each triangle into four similar ones, each boundary edge into two.
Mesh uniformly_refined(const Mesh& mesh);

// Bisects triangles at vertex v until no edge there is longer than length_mm.
//
// A triangle is cut from the middle of its longest edge. So that the mesh stays conforming, the
// neighbour across that edge is cut first until the edge is its longest one too (Rivara, Int. J.
// Numer. Meth. Engng 20, 1984; walked along the longest-edge propagation path, ibid. 40, 1997).
// No angle becomes smaller than half the smallest one before (Rosenberg & Stenger, SIAM J. Numer.
// Anal. 12, 1975). Edges of equal length are ordered by their vertices' numbers, so the path ends.
Mesh bisected_at_vertex(const Mesh& mesh, int v, double length_mm);

// Splits a triangle into three at an inner point p; the first of them lies on side k (see
// MeshEdges::of_triangle) and takes the triangle's number.
void split_at_point(Mesh& mesh, int triangle, int k, const Eigen::Vector2d& p);

}  // namespace airybench
