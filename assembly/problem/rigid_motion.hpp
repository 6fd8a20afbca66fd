// Rigid motions of the plane, u(x) = t + ω J (x − x_c) with J a quarter turn: no strain, no stress.
//
// A prescribed displacement is split into the nearest rigid motion and the rest, which alone
// strains the body. Numbers then have the size of the deformation, however far the body moves.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace airybench {

struct RigidMotion {
  Eigen::Vector2d centre = {0, 0}, translation_mm = {0, 0};
  double rotation = 0;  // ω, rad

  Eigen::Vector2d at(const Eigen::Vector2d& x) const {
    const Eigen::Vector2d d = x - centre;
    return translation_mm + rotation * Eigen::Vector2d(-d.y(), d.x());
  }
  // Moments along an edge (edge_forces.hpp): low end, then high end.
  Eigen::Vector4d moments(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
    const Eigen::Vector2d a = at(low), b = at(high);
    Eigen::Vector4d both;
    both << (2 * a + b) / 3, (a + 2 * b) / 3;
    return both;
  }
  bool is_zero() const { return translation_mm.isZero(0) && rotation == 0; }
};

using EdgeDisplacement = std::function<Eigen::Vector2d(const Eigen::Vector2d& x, int edge)>;

struct PrescribedEdge {
  Eigen::Vector2d start, end;
  int number = 0;
  bool roller = false;
};

struct SplitDisplacement {
  RigidMotion motion;
  EdgeDisplacement rest_mm;  // empty: zero on all edges
};

// The motion that minimises ∫ |u − motion|² (on rollers of the normal parts) over the edges, which
// hold the body (Simpson's rule, exact if u is linear or constant). A constant u is its motion to
// the last digit. A rest that is only rounding of u is zero.
SplitDisplacement split_rigid_motion(const EdgeDisplacement& displacement_mm,
                                     const std::vector<PrescribedEdge>& edges);

}  // namespace airybench
