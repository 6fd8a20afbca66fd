// How wrong an answer of active_rows.hpp is, as the method itself can tell: stiffness_check.hpp
// without a factor of K, and without D.
//
// r are the forces that the recovered stresses and F_C leave, d what correcting the elements would
// add to them, of energy e². One solve under the laws found, K δ = r + d with their slots held, and
// one with F_C held, K δ_F = r + d, to two digits each, give the largest of
//
//   √(e² + δᵀKδ − 2 δ·d) / ‖σ‖                stress, in the energy norm
//   (‖δ‖_K + ‖δ_F‖_K + 2 ‖c‖_D) / √(F·M⁻¹F)   contact forces: Kδ = K δ_F + ΔF, and M⁻¹ ≤ K⁻¹;
//                                             D by its diagonal from below
//   ‖c‖ / ‖F‖                                 contact law, c = F − P(F − ρ r_c) with the
//                                             displacements δ_F corrects and ρ from above
//                                             (contact_compliance.hpp)
//   ‖r‖_∞ / ‖forces‖_∞                        equilibrium
//
// with a half more on the first two, and e/100 on the stress. A wrong law of points on a soft layer
// is nothing in ‖c‖ next to the forces of a stiff one, but not in ‖c‖_D; the factor 2 is that of
// ALM's estimate (docs/theory-errors.md).
#pragma once

#include "assembly/problem/load_scale.hpp"
#include "solvers/active_sets/active_rows.hpp"
#include "solvers/condensation/stiffness_check.hpp"

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
