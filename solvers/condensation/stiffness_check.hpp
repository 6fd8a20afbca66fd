// How wrong an answer in displacements is, as the method itself can tell.
//
// The recovered stresses leave unbalanced forces r at the unknowns, F_C held. One more solve with
// the factor of K gives the correction δ = K⁻¹ r, the error to its leading digits. The estimate is
// the largest of
//
//   √(rᵀδ) / ‖σ‖             stress, in the energy norm
//   ‖F − P(F − ρ r_c)‖ / ‖F‖ contact law, with the corrected displacements
//   ‖r‖_∞ / ‖forces‖_∞       equilibrium
//
// or relative to the loads where there is next to no stress (load_scale.hpp).
#pragma once

#include "assembly/dual_system.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/solution.hpp"

namespace airybench {

struct UnbalancedForces {
  Eigen::VectorXd r;   // N, one per unknown
  double largest = 0;  // of the forces that should balance, N
};

// Sets the solution's estimate from its F_C and stress, and says `inaccurate` where it is ok so far
// and the estimate is above the target. displacement: u_C that belongs to F_C.
void check_stiffness_answer(const Problem& problem, const ContactPoints& contact,
                            const CondensedSystem& condensed, const UnbalancedForces& unbalanced,
                            const Eigen::VectorXd& displacement, StiffnessFactor& factor,
                            const RunControl& control, Solution& solution);

}  // namespace airybench
