// Shape of triangles.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench {

// Smallest angle, degrees.
double smallest_angle_deg(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c);

// Mean ratio q = 4√3 A / (l₁² + l₂² + l₃²): 1 equilateral, 0 flat, negative clockwise.
double mean_ratio(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

struct MeshQuality {
  double smallest_angle_deg = 0;
  double min_mean_ratio = 0;
  double mean_mean_ratio = 0;  // over the triangles, unweighted
};
// Of a mesh with at least one triangle.
MeshQuality mesh_quality(const Mesh& mesh);

}  // namespace airybench
