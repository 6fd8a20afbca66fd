// Rigid motions of the plane, u(x) = t + ω J (x − x_c) with J a quarter turn: no strain, no stress.
//
// A prescribed displacement is split into the rigid motion that is nearest to it and the rest,
// which alone strains the body. Numbers then have the size of the deformation, however far the body
// is moved.
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
  // Its moments along an edge (edge_forces.hpp): those of its low end, then of its high one.
  Eigen::Vector4d moments(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
    const Eigen::Vector2d a = at(low), b = at(high);
    Eigen::Vector4d both;
    both << (2 * a + b) / 3, (a + 2 * b) / 3;
    return both;
  }
  bool is_zero() const { return translation_mm.isZero(0) && rotation == 0; }
};

// A displacement on edges, each with a number of its own.
using EdgeDisplacement = std::function<Eigen::Vector2d(const Eigen::Vector2d& x, int edge)>;

// A straight piece of boundary where a displacement is prescribed, on a roller its normal part.
struct PrescribedEdge {
  Eigen::Vector2d start, end;
  int number = 0;
  bool roller = false;
};

// What is left of a displacement without the motion.
struct SplitDisplacement {
  RigidMotion motion;
  EdgeDisplacement rest_mm;  // empty: zero on all edges
};

// The motion that minimises ∫ |u − motion|², of rollers the normal parts, over the edges; these
// hold the body (Simpson's rule, exact where u is linear or constant). A constant u is its motion
// to the last digit. A rest that is only the rounding of u is zero.
SplitDisplacement split_rigid_motion(const EdgeDisplacement& displacement_mm,
                                     const std::vector<PrescribedEdge>& edges);

}  // namespace airybench
