// The constitutive relation error: how far apart a stress and a displacement are of which each is
// admissible, and so how far each may be from the exact solution (Prager & Synge 1947; Ladevèze &
// Leguillon 1983, doi:10.1137/0720033; with contact: Coorevits, Hild & Pelle 2000; with friction:
// Coorevits, Hild & Hjiaj 2001).
//
// σ balances b and f with σ_n ≤ 0, |σ_t| ≤ −μ σ_n on Γ_C; u = u0 on Γ_D and u_n ≤ g0 on Γ_C. Then
//
//   e² = ∫ (σ − Aε(u)):C:(σ − Aε(u))  +  2 ∫_{Γ_C} σ_n (u_n − g0)  +  2 ∫_{Γ_C} μ|σ_n||u_t| + σ_t
//   u_t
//
// and every term is ≥ 0. Here g0 is the wall's own, not the quadratic one that a discrete problem
// has of it (wall_gap.hpp); of load steps, u_t is less what has slipped before. e = 0 exactly when
// σ and u solve the problem. Without friction
//
//   e² = 2 (Π(u) + Π*(σ)),    −Π*(σ) ≤ Π(u_exact) = −Π*(σ_exact) ≤ Π(u)
//
// where each bound is guaranteed, and ‖σ − σ_exact‖, ‖A ε(u) − σ_exact‖ ≤ e. With Coulomb's law it
// is an estimator only.
//
// Without friction also ‖σ − σ_exact‖² + ‖Aε(u) − σ_exact‖² ≤ e², so that the mean of both is
// nearer to σ_exact than either is known to be (the hypercircle; Synge 1957):
//
//   ‖½(σ + Aε(u)) − σ_exact‖² ≤ ½ e² − ¼ ‖σ − Aε(u)‖² = ¼ body + ½ contact
//
// where body and contact are the terms of e²: half of e where the contact terms are small. The mean
// does not balance the loads.
#pragma once

#include <string>

#include "assembly/displacement_field.hpp"
#include "assembly/dual_system.hpp"

namespace airybench {

struct ConstitutiveError {
  // The terms of e², N mm.
  double body_Nmm = 0, normal_contact_Nmm = 0, tangential_contact_Nmm = 0;
  // Where a wall ends inside an edge, the pressure beyond it belongs to no wall: about what it
  // would take to be rid of it. Such a σ is not admissible, and nothing is guaranteed.
  double beyond_wall_Nmm = 0;
  std::vector<double> of_triangle_Nmm;  // they sum to e²; contact terms are with their triangles
  double relative = 0;                  // e / ‖σ‖, or to the loads where there is no stress
  double relative_of_mean = 0;          // the same of ½(σ + Aε(u))
  double lower_bound_Nmm = 0;           // −Π*(σ), less an allowance for rounding
  double upper_bound_Nmm = 0;           // Π(u), and more by it
  // e and the two are bounds: no friction, no wall that ends inside an edge, and no flaw.
  bool guaranteed = false;
  // Why e is no error: a field that is not admissible, as where Γ_D is pushed through the wall at
  // its end on Γ_C, which no displacement of finite energy can do. Empty: it is one.
  std::string flaw;

  double squared_Nmm() const {
    return body_Nmm + normal_contact_Nmm + tangential_contact_Nmm + beyond_wall_Nmm;
  }
  double squared_of_mean_Nmm() const { return squared_Nmm() / 2 - body_Nmm / 4; }
};

// ½(σ + Aε(u)).
StressField mean_stress(const Problem& problem, const StressField& stress,
                        const DisplacementField& u);

// stress and F_C at the contact points of `system`, as from an equilibrium method; u as from P2.
ConstitutiveError constitutive_error(const DualSystem& system, const StressField& stress,
                                     const Eigen::VectorXd& F_C, const DisplacementField& u);

}  // namespace airybench
