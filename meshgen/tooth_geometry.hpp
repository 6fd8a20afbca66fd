// One tooth, or a rack of equal teeth, as a closed polygon of boundary edges.
//
//     y                     tooth (teeth = 1): root at x = 0, tip at x = l
//     r |\__                  displacement x = 0, contact x = l, force: the flanks
//       |   \__ t
//       |      |  x         rack (teeth = N > 1): block −d <= x <= 0, 0 <= y <= pitch·N, with such
//       |    __| −t         teeth on its right face, centred at y = pitch/2 + pitch·k
//       | __/                  displacement x = −d, contact x = l, force: all else
//    −r |/      l
//
// The edge length wanted at x runs geometrically from the displacement face x_D to the tips x_C:
//   h(x) = h_D (h_C/h_D)^ξ,   ξ = (x − x_D)/(x_C − x_D),
// with h_D, h_C the (equal) edge lengths there, length over number of edges. The edges of a force
// segment divide its ∫ds/h equally.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

struct ToothDimensions {
  int teeth = 1;                // 1: one tooth without a block; more: a rack
  double root_half_height = 5;  // r, mm
  double length = 10;           // l, mm
  double tip_half_height = 3;   // t, mm
  double pitch = 12.5;          // mm, rack only
  double block_depth = 6;       // d, mm, rack only
};

struct EdgeCounts {
  int displacement = 0;
  int force = 0;
  int contact = 0;
  int total() const { return displacement + force + contact; }
};

struct BoundarySegment {
  Eigen::Vector2d start, end;  // mm
  BoundaryRole role;
  double length() const { return (end - start).norm(); }
};

struct SizeField {
  double x_d, x_c;  // mm
  double h_d, h_c;  // mm
  // h at x, with ξ^exponent in place of ξ; ξ is kept within [0, 1].
  double at(double x, double exponent = 1) const;
};

// Edge i runs from vertex i to vertex i+1 (the last one back to 0) and has role i; walked
// counter-clockwise. Coordinates in mm, rounded to 1e-10.
struct BoundaryPolygon {
  std::vector<Eigen::Vector2d> vertices;
  std::vector<BoundaryRole> roles;
};

// A coordinate in mm rounded to 1e-10, never −0.
double rounded_coordinate(double value);

// These throw std::invalid_argument, one line naming the value and what is allowed, for dimensions
// that make no body or for too few edges (one per segment is needed).
std::vector<BoundarySegment> boundary_segments(const ToothDimensions& dimensions);
SizeField size_field(const ToothDimensions& dimensions, const EdgeCounts& edges);
BoundaryPolygon boundary_polygon(const ToothDimensions& dimensions, const EdgeCounts& edges);

}  // namespace airybench
