// How wrong an answer in displacements is, as the method itself can tell.
//
// The recovered stresses leave unbalanced forces r at the unknowns, F_C held, and an element may
// find that its stress is not the one of its displacements: corrected, of energy e² in all, the
// elements add forces d. One more solve with the factor of K gives δ = K⁻¹ (r + d), the error to
// its leading digits, and both corrections together have the energy e² + δ·(r − d), most of e²
// being what δ takes back. With δ, contact forces are off by ΔF (check_contact). The estimate is
// the largest of
//
//   (√(e² + δ·(r − d)) + ‖ΔF‖_D) / ‖σ‖   stress, in the energy norm
//   ‖ΔF‖_D / ‖F‖_D                       contact forces
//   ‖F − P(F − ρ r_c)‖ / ‖F‖             contact law, with the corrected displacements
//   ‖r‖_∞ / ‖forces‖_∞                   equilibrium
//
// or relative to the loads where there is no stress (load_scale.hpp).
#pragma once

#include "assembly/contact_system.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench {

struct UnbalancedForces {
  Eigen::VectorXd r;         // N, one per unknown
  double largest = 0;        // of the forces that should balance, N
  Eigen::VectorXd defect;    // what correcting the elements would add to r; empty: zero
  double defect_energy = 0;  // e², N mm
};

// Sets the solution's estimate from its F_C and stress, and says `inaccurate` where it is ok so far
// and the estimate is above the target. displacement: u_C that belongs to F_C.
void check_stiffness_answer(const Problem& problem, const contact::Problem& condensed,
                            const UnbalancedForces& unbalanced, const Eigen::VectorXd& displacement,
                            StiffnessFactor& factor, const RunControl& control, Solution& solution);

}  // namespace airybench
