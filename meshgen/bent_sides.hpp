// Sides of a mesh that stand for curves: of the open Gmsh model's geometry, or of its elements.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
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
  bool is_closed_ = false;
  std::map<std::size_t, double> parameter_;  // of its nodes
};

// The nodes inside the sides of elements of higher order.
class SideNodes {
 public:
  using Span = std::span<const std::size_t>;
  // A triangle or quadrilateral: its corners and its other nodes, those of its sides first.
  void add_element(Span corners, Span others);
  // A line; what has more nodes than a curve has points is left out.
  void add_side(std::size_t from, std::size_t to, Span inside);
  std::vector<std::size_t> between(std::size_t from, std::size_t to) const;

 private:
  std::map<std::array<std::size_t, 2>, std::vector<std::size_t>> inside_;  // from low to high
};

// Through points at equidistant parameters; straight within the rounding of the points. None if
// there are more points than a curve has coefficients, and it misses them by more than a hundredth
// of its sagitta: the curve bends between two nodes.
std::optional<EdgeCurve> curve_through(const std::vector<Eigen::Vector2d>& points_mm,
                                       double mm_per_unit);

}  // namespace airybench
