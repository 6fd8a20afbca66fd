// How wrong an answer of active_rows.hpp is, as the method itself can tell: stiffness_check.hpp
// without a factor of K, and without D.
//
// r are the forces that the recovered stresses and F_C leave, d what correcting the elements would
// add to them, of energy e². One solve under the laws found, K δ = r + d with their slots held, and
// one with F_C held, K δ_F = r + d, to two digits each, give the largest of
//
//   √(e² + δᵀKδ − 2 δ·d) / ‖σ‖                stress, in the energy norm
//   (‖δ‖_K + ‖δ_F‖_K) / √(F·M⁻¹F)             contact forces: Kδ = K δ_F + ΔF, and M⁻¹ ≤ K⁻¹
//   ‖F − P(F − ρ r_c)‖ / ‖F‖                  contact law, with the displacements δ_F corrects and
//                                             ρ from above (contact_compliance.hpp)
//   ‖r‖_∞ / ‖forces‖_∞                        equilibrium
//
// with a half more on what is solved for.
#pragma once

#include "solvers/condensation/hybridized.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {

// Sets the solution's estimate from its F_C, stress and contact displacements. compliance: the
// diagonal of D from below.
void check_rows_answer(const Problem& problem, const SlotSystem& slots, const EdgeUnknowns& unknown,
                       const UnbalancedForces& unbalanced, const std::vector<PointLaw>& laws,
                       const Eigen::VectorXd& compliance, TwoLevelPreconditioner& M,
                       const RunControl& control, Solution& solution);

}  // namespace airybench
