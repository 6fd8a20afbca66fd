// Prescribed tractions as forces F_j of an edge (equilibrium_element.hpp, curved_side.hpp).
#pragma once

#include "assembly/problem/problem.hpp"

namespace airybench {

// F_j of the prescribed traction on an edge of Γ_F, from its start on; N. On a chord it is linear,
// and its control values lie on it. Scalar: double, Wide.
template <typename Scalar>
Eigen::Matrix2X<Scalar> traction_forces(const Problem& problem, int row, int degree);

}  // namespace airybench
