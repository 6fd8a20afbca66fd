// What stands in for a reference where a body is too large for one: whether an answer's stresses
// are those of its own edge displacements, which make a compatible field, and these meet the
// contact law.
//
// With the equilibrium of the stresses that is all that the discrete problem asks for. It bounds no
// error: how far the answer is from the exact one, only the method's own estimate says.
#pragma once

#include "assembly/dual_system.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// Above so many degrees of freedom n_φ no reference is computed.
inline constexpr int largest_with_reference = 1'000'000;

struct MomentsCheck {
  StressField stress;                    // of the edge displacements, u0 on Γ_D; MPa
  Eigen::VectorXd contact_displacement;  // ū_C, mm; in the rows of F_C
};
// From Solution::edge_moments, by the elements of hybridized.hpp in double.
MomentsCheck check_moments(const DualSystem& system, const Eigen::Matrix4Xd& edge_moments);

}  // namespace airybench
