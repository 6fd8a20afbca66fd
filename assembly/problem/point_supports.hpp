// Supports in points, which take out rigid motions that nothing else holds: three components in two
// points hold a body whose loads balance (3-2-1 in space). Such points carry no force, so that they
// choose among displacements with the same stresses. A force in a point has infinite stress, and
// where one is needed the scene is refused.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "mesh/mesh.hpp"

namespace airybench {

struct PointSupport {
  Eigen::Vector2d at_mm = {0, 0};
  std::array<std::optional<double>, 2> displacement_mm = {};  // u_x, u_y; none: free
  std::string body = {};  // to which it belongs where bodies meet; empty: the only one
};

struct PlaceInMesh {
  int triangle;
  Eigen::Vector3d lambda;
};
// None: off the mesh, or off the point's body.
std::optional<PlaceInMesh> place_in_mesh(const Mesh& mesh, const PointSupport& point);

}  // namespace airybench
