// Whether the largest pressure on Γ_C is finite: by the places where theory allows an infinite one,
// and by what a solution shows there.
//
// Between smooth faces the pressure of a solution is bounded. It may be infinite only
//
//   - where a face ends in contact, unless the end is a regular one. By reflection these are: a
//     free side at ω ≤ 90° to the face, without friction; a roller at 90°, without friction or
//     where the end sticks;
//   - at a kink of the gap that protrudes into a body: where the slope of g0 jumps by κ > 0 the
//     pressure is like E' κ ln(1/r) (the wedge's p = E' κ/(2π) arcosh(a/r), Johnson 1985, 5.2);
//   - at an end or a step of a wall, a corner of a face, a change of friction or of materials.
//
// An edge to edge angle is a corner only if the contact law's normal turns there: a polygon that
// stands for a curve has the curve's normals and gap.
//
// Without such a place in contact the peak is bounded. It is unbounded if the largest pressure of
// the stresses lies at one and grows towards it: the mean pressures m_k over windows of 2^k edge
// lengths from there gain m_0 − m_1, m_1 − m_2, … with each halving, by a factor that is at least 1
// for ln r and r^−α, and 0.7 for the cusp √r. Anything else is not seen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "assembly/contact_system.hpp"

namespace airybench {

enum class PressurePeak { bounded, unbounded, not_seen };
constexpr const char* name_of(PressurePeak peak) {
  constexpr std::array<const char*, 3> names = {"bounded", "unbounded", "not seen"};
  return names[static_cast<std::size_t>(peak)];
}

// Of those edges of Γ_C that are asked for, per row of Mesh::boundary. F_C: at the contact points
// of `system`.
PressurePeak pressure_peak(const ContactSystem& system, const Eigen::VectorXd& F_C,
                           const std::vector<bool>& asked);

}  // namespace airybench
