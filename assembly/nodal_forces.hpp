// Stiffness and forces of displacements of degree p (displacement_field.hpp), as work partners of
// their coefficients. Where the body has curved sides (Problem::round) these are integrals up to
// the curves, of the triangles' polynomials continued to them:
//
//   K = ∫ ε(B):A:ε(B'),   V4 + ρ (x(ξ) − V4), 0 ≤ ρ ≤ 1: the points of a side's third
//
// by the Gauss sums of curved_side.hpp.
#pragma once

#include "assembly/displacement_field.hpp"

namespace airybench {

// K, N/mm, of the coefficients of a triangle, up to its curves.
DisplacementTriangle::Stiffness triangle_stiffness(const Problem& problem, int degree, int triangle,
                                                   const Eigen::Matrix3d& elasticity);

// Per node ∫ σ:ε(u_i), N, of the stresses σ of u; a triangle's largest contribution.
struct NodalForces {
  Eigen::Matrix2Xd sum;
  double largest = 0;
};
NodalForces nodal_forces(const Problem& problem, const DisplacementField& u);
// Those of σ* = A ε0, of displacements of a degree.
Eigen::Matrix2Xd thermal_forces(const Problem& problem, int degree);

// ∫ b B_i + ∫_{Γ_F} f B_i, N: the work partners of the coefficients. f is that of each
// point on curves, and linear on chords.
Eigen::Matrix2Xd nodal_loads(const Problem& problem, int degree = 2, Sides sides = Sides::curves);

// ∫ b·u + ∫_{Γ_F} f·u, N mm.
double work_of_loads(const Problem& problem, const DisplacementField& u,
                     Sides sides = Sides::curves);
// The same of free pieces' own motions, of these amounts, zero where there are none. degree: that
// of the stresses or displacements, which may follow curved sides (Problem::round).
double work_on_free_motion(const Problem& problem, const FreeMotions& free, int degree = 1);

}  // namespace airybench
