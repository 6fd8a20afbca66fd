// Longest-edge bisection: finer meshes of the same body, where they are asked for.
//
// A triangle is cut from the middle of its longest edge. So that the mesh stays conforming, the
// neighbour across that edge is cut first until the edge is its longest one too (Rivara, Int. J.
// Numer. Meth. Engng 20, 1984; walked along the longest-edge propagation path, ibid. 40, 1997).
// Where edges are straight, no angle becomes smaller than half the smallest one before, however
// often this is repeated (Rosenberg & Stenger, SIAM J. Numer. Anal. 12, 1975). Edges of equal
// length are ordered by their vertices' numbers, so every path ends, and the same marks give the
// same mesh.
//
// A curved boundary edge is cut at the middle of its curve. Where a triangle becomes too thin for
// its curved edge (fits()), that edge is cut, too: half of it turns half as much.
//
// New vertices are put behind the old ones, new triangles and boundary edges too; roles, groups and
// bodies are inherited. Time and memory are linear in the triangles of the result.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "mesh/mesh.hpp"

namespace airybench {

struct BisectedMesh {
  Mesh mesh;
  // Triangles and parts of them that were left: the middle of their longest edge could not be told
  // apart from its ends, with 64 roundings of the largest coordinate between them.
  int too_small = 0;
  std::int64_t visits = 0;  // triangles looked at on the way, each once per look
};

// A triangle of the mesh, or a part that it has been cut into.
struct TrianglePart {
  int triangle = 0;  // of the mesh before
  int cuts = 0;      // that have made the part; 0: it is the whole triangle
  std::array<Eigen::Vector2d, 3> corners;
};

// Cuts every triangle and then every part that is due. Takes a valid mesh; returns one.
BisectedMesh bisected(const Mesh& mesh, const std::function<bool(const TrianglePart&)>& is_due);

// Until each part comes from at least so many cuts. cuts: per triangle, 0 where it is not marked.
BisectedMesh bisected(const Mesh& mesh, const std::vector<int>& cuts);

// Bisects triangles at vertex v until no edge there is longer than length_mm.
Mesh bisected_at_vertex(const Mesh& mesh, int v, double length_mm);

// Cuts curved edges until their triangles fit them. An edge whose curve reaches the vertex across
// stays as it is; it is cut on its chord, if it is cut.
Mesh with_fitting_curves(Mesh mesh);

// The shortest edge, in mm, that bisection may halve in a mesh of these coordinates.
double shortest_divisible_edge(const Mesh& mesh);

}  // namespace airybench
