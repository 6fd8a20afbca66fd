// An admissible displacement from an equilibrium method's own answer, by local work: what a
// constitutive relation error needs (discretisation_error.hpp) without a second global solve.
//
// On each triangle the quadratic displacement whose stress is nearest to σ in the energy norm.
// Strains of quadratic displacements are all linear fields, and C is constant on a triangle: so
//   ε(w) = C Π σ,   Π the L² projection on linear fields,
// which is integrated in closed form. The rigid motion that this leaves free is the one by which w
// is nearest to the edge displacements ū in their moments (least squares over the edges' ends).
//
// The coefficients of a vertex or an edge are then averaged over its triangles, weighted by the
// diagonals k of their stiffnesses, and set to u0 on Γ_D. On Γ_C they take the proximal step of the
// contact terms of e²: with F = ∫ σn B, w_n moves by −F_n/k towards the wall and no further, w_t by
// −F_t/k and then up to μ|F_n|/k back to where the body has not slid. Terms that would be of first
// order in the error of w, as σ_n (u_n − g0) where the contact is closed, so become quadratic.
// Every contact edge's own u_n ≤ g0 holds, on curved faces, too, and between the points that its
// quadratic gap knows: another one is below all of the wall (wall_gap.hpp).
//
// One damped Jacobi step on ‖σ − Aε(w)‖² follows, with the same on Γ_D and Γ_C. e is then about 1.1
// times that with P2's displacement, which without friction is the least (measured; 1.4 without
// this step).
//
// Where ν is near ½, two sweeps over vertex stars (vertex_stars.hpp) then move all that no
// constraint is on; e is at most 1.7 times that with P2's displacement up to ν = 0.4999 (14
// without).
//
// The idea of averaging is Zienkiewicz & Zhu's (1987), that of going from stresses to an admissible
// displacement Ladevèze's (discretisation_error.hpp): whatever the field, if it is admissible, e is
// the error that is said there.
#pragma once

#include "assembly/displacement_field.hpp"
#include "assembly/dual_system.hpp"

namespace airybench {

// Coefficients of w, as P2 gives them. stress, F_C, edge_moments: of one Solution.
DisplacementField recovered_displacement(const DualSystem& system, const StressField& stress,
                                         const Eigen::VectorXd& F_C,
                                         const Eigen::Matrix4Xd& edge_moments);

// The admissible displacement nearest to the given one in the same way: Γ_D and Γ_C as above.
DisplacementField admissible_displacement(const DualSystem& system, const Eigen::VectorXd& F_C,
                                          DisplacementField w);

}  // namespace airybench
