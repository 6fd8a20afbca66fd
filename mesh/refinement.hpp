// Finer meshes of the same body, by four or by one vertex; by bisection: bisection.hpp. New
// vertices are put behind the old ones, those of curved edges onto their curve; roles and bodies
// are inherited.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench {

// Each triangle into four, similar ones where its edges are straight; each boundary edge into two.
Mesh uniformly_refined(const Mesh& mesh);

// Splits a triangle into three at an inner point p; the first of them lies on side k (see
// MeshEdges::of_triangle) and takes the triangle's number.
void split_at_point(Mesh& mesh, int triangle, int k, const Eigen::Vector2d& p);

}  // namespace airybench
