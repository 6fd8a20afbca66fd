// Sides of a mesh that stand for curves: of the open Gmsh model's geometry, or of its elements.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

#include "mesh/edge_curve.hpp"

namespace airybench {

// A curve of the open Gmsh model that has more than its mesh.
class CurveGeometry {
 public:
  explicit CurveGeometry(int curve);
  // At equidistant parameters from one of its nodes to the next, 2 EdgeCurve::max_degree + 1 of
  // them, in the model's unit; none: it has no geometry there.
  std::vector<Eigen::Vector3d> between(std::size_t node, std::size_t next) const;

 private:
  int curve_;
  double low_ = 0, high_ = 0;
  std::map<std::size_t, double> parameter_;  // of its nodes
};

// Through points at equidistant parameters. Straight within the rounding of the points; straight,
// too, if there are more points than a curve has coefficients, and it misses them by more than a
// hundredth of its sagitta: the curve bends between two nodes.
EdgeCurve curve_through(const std::vector<Eigen::Vector2d>& points_mm, double mm_per_unit);

}  // namespace airybench
