// The constitutive relation error: the distance between an admissible stress and an admissible
// displacement, which bounds the distance of each from the exact solution (Prager & Synge 1947;
// Ladevèze & Leguillon 1983, doi:10.1137/0720033; with contact: Coorevits, Hild & Pelle 2000; with
// friction: Coorevits, Hild & Hjiaj 2001).
//
// σ balances b and f with σ_n ≤ 0, |σ_t| ≤ −μ σ_n on Γ_C; u = u0 on Γ_D and u_n ≤ g0 on Γ_C. Then
//
//   e² = ∫ (σ − Aε(u)):C:(σ − Aε(u))
//        + 2 ∫_{Γ_C} σ_n (u_n − g0)  +  2 ∫_{Γ_C} μ|σ_n||u_t| + σ_t u_t
//
// and every term is ≥ 0. An e² < 0 that rounding explains (1e-11 of the strain energies) is zero up
// to its size, which is given instead. g0 is the true gap to the wall, not its quadratic
// approximation (wall_gap.hpp). In load steps u_t excludes the slip of earlier steps. e = 0 exactly
// if σ and u solve the problem. Without friction
//
//   e² = 2 (Π(u) + Π*(σ)),    −Π*(σ) ≤ Π(u_exact) = −Π*(σ_exact) ≤ Π(u)
//
// where each bound is guaranteed, and ‖σ − σ_exact‖, ‖A ε(u) − σ_exact‖ ≤ e. With Coulomb's law e
// is only an estimator.
//
// Without friction also ‖σ − σ_exact‖² + ‖Aε(u) − σ_exact‖² ≤ e², so the mean of both has a smaller
// bound (the hypercircle; Synge 1957):
//
//   ‖½(σ + Aε(u)) − σ_exact‖² ≤ ½ e² − ¼ ‖σ − Aε(u)‖² = ¼ body + ½ contact
//
// where body and contact are the terms of e². This is half of e if the contact terms are small. The
// mean does not balance the loads.
//
// Where the body has curved sides, e is that of the body between their chords, and η² is added for
// the rest (geometry_error.hpp).
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "assembly/contact_system.hpp"
#include "assembly/displacement_field.hpp"

namespace airybench {

// How far faces in contact slide along another body or a wall that curves, which is not in the
// error: in small displacements they press on what faced them at first.
struct Sliding {
  double mm = 0;     // the largest slide of an edge in contact, from the start of a path on
  double edges = 0;  // the largest over the edge's length
  double turn = 0;   // the largest angle by which the law's normal turns on that way

  void include(const Sliding& other) {
    for (double Sliding::*part : {&Sliding::mm, &Sliding::edges, &Sliding::turn})
      this->*part = std::max(this->*part, other.*part);
  }
};

struct ConstitutiveError {
  double body_Nmm = 0, normal_contact_Nmm = 0, tangential_contact_Nmm = 0;
  double geometry_Nmm = 0;  // η² of curved sides (geometry_error.hpp); nothing is guaranteed then
  // If a wall ends inside an edge, pressure acts beyond it. This term estimates the energy to
  // remove it. Such a σ is not admissible, so nothing is guaranteed.
  double beyond_wall_Nmm = 0;
  std::vector<double> of_triangle_Nmm;  // sum to e²; contact terms count for their triangles
  std::vector<double> of_chords_Nmm;    // of them, η² where curves are taken as their chords
  double stress_norm = 0, displacement_norm = 0;  // ‖σ‖, ‖Aε(u)‖; √(N mm)
  double relative = 0;  // e / ‖σ‖; without stress e / ‖ε(û)‖, or relative to the loads
  double relative_of_mean = 0;  // the same for ½(σ + Aε(u))
  double lower_bound_Nmm = 0;   // −Π*(σ) minus an allowance for rounding
  double upper_bound_Nmm = 0;   // Π(u) plus that allowance
  // e and both bounds hold: no friction, no flaw, no curved sides, and no wall that curves or ends
  // along an edge.
  bool guaranteed = false;
  // Why a field is not admissible and e is no error; empty if it is one. Example: u0 pushes an end
  // of Γ_D through the wall, which no displacement of finite energy can do.
  std::string flaw;
  Sliding sliding;

  double squared_Nmm() const {
    return body_Nmm + normal_contact_Nmm + tangential_contact_Nmm + beyond_wall_Nmm + geometry_Nmm;
  }
  double squared_of_mean_Nmm() const { return (squared_Nmm() + geometry_Nmm) / 2 - body_Nmm / 4; }
};

// ½(σ + Aε(u)).
StressField mean_stress(const Problem& problem, const StressField& stress,
                        const DisplacementField& u);

// stress, F_C: from an equilibrium method, at the contact points of `system`; u: of the
// stresses' degree plus one.
ConstitutiveError constitutive_error(const ContactSystem& system, const StressField& stress,
                                     const Eigen::VectorXd& F_C, const DisplacementField& u);

}  // namespace airybench
