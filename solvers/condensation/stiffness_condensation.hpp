// From the Cholesky factor of a stiffness to the condensed contact problem, the contact
// displacements being the last unknowns:
//
//   ⎡ K_II K_IC ⎤ ⎡ u_I ⎤   ⎡ b_I       ⎤      K_c = K_CC − K_CI K_II⁻¹ K_IC,   D = K_c⁻¹
//   ⎣ K_CI K_CC ⎦ ⎣ u_C ⎦ = ⎣ b_C + F_C ⎦      G = −D (b_C − K_CI K_II⁻¹ b_I)
//
// With K = L Lᵀ and y = L⁻¹ b (multifrontal.hpp), K_c = L_CC L_CCᵀ and G = −L_CC⁻ᵀ y_C: no solve
// with n_c right-hand sides. Given u_C, the inner unknowns come from Lᵀ u = (y_I, L_CCᵀ u_C).
#pragma once

#include "solvers/base/solution.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/direct/multifrontal.hpp"

namespace airybench {

// K's factor and y = L⁻¹ b.
struct StiffnessFactor {
  MultifrontalFactor cholesky;
  Eigen::VectorXd y;
};

// D and G; empty without contact.
CondensedSystem condense(const StiffnessFactor& factor);
// G of other loads b, D as it is: y and G anew.
void condense_load(const Eigen::VectorXd& b, StiffnessFactor& factor, CondensedSystem& condensed);

// Orders, factorises and condenses K u = b + F_C, n_c contact unknowns last: the factor, D and G,
// their stages' times and bytes into the solution. system: what messages call it.
CondensedSystem factorise_and_condense(const ElementMatrices& K, const Eigen::VectorXd& b, int n_c,
                                       const std::string& system, const RunControl& control,
                                       StiffnessFactor& factor, Solution& solution);

// All unknowns u, from the contact displacements u_C.
Eigen::VectorXd all_displacements(StiffnessFactor& factor,
                                  const Eigen::VectorXd& contact_displacement);

}  // namespace airybench
