// A body of layers: the line n·x = d cuts the plane, and the layers' interfaces are such lines.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {

// Either a number of layers, equally thick between the smallest and the largest n·x of the body, or
// their interfaces; neither: the mesh keeps its bodies.
struct Layers {
  Eigen::Vector2d normal = {1, 0};    // not zero; any length
  int count = 0;                      // 0 to max_layers; used when there are no interfaces
  std::vector<double> interfaces_mm;  // n·x with n = normal/|normal|, ascending

  bool none() const { return count == 0 && interfaces_mm.empty(); }
};
inline constexpr int max_layers = 1000;

// Throws TransformError when a value is impossible on any mesh.
void check_values(const Layers& layers);

// Makes the layers the mesh's bodies, "layer 1", "layer 2", … in the direction of n: a triangle
// belongs to the layer of its centroid, so interfaces follow the edges that are there. Throws
// TransformError, too, when a layer has no triangle.
Mesh layered(Mesh mesh, const Layers& layers);

}  // namespace airybench
