// How wrong an answer of active_rows.hpp is, as the method itself can tell: stiffness_check.hpp
// without a factor of K, and without D.
//
// r are the forces that the recovered stresses and F_C leave, d what correcting the elements would
// add to them, of energy e². One solve under the laws found, K δ = r + d with their slots held, and
// one with F_C held, K δ_F = r + d, to two digits each, give the largest of
//
//   √(e² + δᵀKδ − 2 δ·d) / ‖σ‖                stress, in the energy norm
//   (‖δ‖_K + ‖δ_F‖_K + 2 ‖e_c‖_D) / √(F·M⁻¹F)  contact forces: Kδ = K δ_F + ΔF, and M⁻¹ ≤ K⁻¹
//   ‖e_c‖ / ‖F‖   contact law: e_c = F − P(F − ρ r_c) with the displacements that δ_F corrects and
//                 ρ = 1/D_jj from above (contact_compliance.hpp); by it, in the D norm with D_jj
//                 alone, forces are off twice (docs/theory.md, ALM's estimate). On a soft layer
//                 next to a stiff one a point's law may be wrong and ‖e_c‖ nothing next to ‖F‖
//   ‖r‖_∞ / ‖forces‖_∞                        equilibrium
//
// with a half more on what is solved for.
#pragma once

#include "assembly/load_scale.hpp"
#include "solvers/condensation/stiffness_check.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {

// Of all processes that share the body, but for the vectors in slots.
struct RowsAnswer {
  const std::vector<PointLaw>& laws;
  const Eigen::VectorXd &F_C, &u_C;
  const Eigen::VectorXd& compliance;  // the diagonal of D from below
  double stress_norm = 0, largest_r = 0;
  LoadScale scale;
};
// unbalanced: in slots. Adds the linear iterations.
double rows_error(ContactRows& rows, UnbalancedForces unbalanced, const RowsAnswer& answer,
                  std::int64_t& iterations);

}  // namespace airybench
