// An admissible displacement from an equilibrium method's answer by local work. The constitutive
// relation error (discretisation_error.hpp) then needs no second global solve.
//
// For stresses of degree k, w has the degree k + 1. On each triangle it is the displacement whose
// stress is nearest to σ in the energy norm (own_displacement.hpp). Its free rigid motion is fitted
// to the moments of the edge displacements ū (least squares over all moments of its edges).
//
// The coefficients of a vertex or edge are averaged over its triangles with the diagonals d of
// their stiffnesses as weights, and made admissible (displacement_constraints.hpp): u0 on Γ_D, and
// on Γ_C the proximal step of the contact terms of e². Terms that would be of first order in the
// error of w, such as σ_n (u_n − g0) in closed contact, become quadratic. Every contact edge
// satisfies u_n ≤ g0, also on curved faces and between the points of its quadratic gap: a second
// quadratic stays below the whole wall (wall_gap.hpp).
//
// Three pairs of damped Jacobi steps on ½ e² and the same treatment of Γ_D and Γ_C follow. For ν
// near ½, two sweeps over vertex stars (vertex_stars.hpp) improve all unconstrained coefficients
// before the last step, which shows what more there is to gain. Where that is much, as in thin
// triangles, whose nodes hold one another, the recovery solves for a zone (zone_recovery.hpp).
// Coefficients inside triangles are those that minimise e at last.
//
// e over that of P_{k+1}'s displacement, the least one without friction (measured): at most 1.14 on
// triangles of any shape as meshers and bisection make them; 1.07 between bodies whose vertices do
// not match, smallest angles down to 0.04° (1.00 at the median; 580 without zones).
//
// Averaging is due to Zienkiewicz & Zhu (1987), admissible displacements from stresses to Ladevèze
// (discretisation_error.hpp).
#pragma once

#include <optional>

#include "assembly/contact_system.hpp"
#include "assembly/displacement_field.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// Coefficients of w. The answer must have edge displacements.
DisplacementField recovered_displacement(const ContactSystem& system, const Solution& answer);
// The same, or of displacements these; of other answers there is none.
std::optional<DisplacementField> displacement_of_answer(const ContactSystem& system,
                                                        const Solution& answer);

// Makes w admissible: applies the treatment of Γ_D and Γ_C above.
DisplacementField admissible_displacement(const ContactSystem& system, const Eigen::VectorXd& F_C,
                                          DisplacementField w);

}  // namespace airybench
