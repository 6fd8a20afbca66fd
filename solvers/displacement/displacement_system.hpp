// P2, P3, P4: the displacement method with continuous displacements of degree p, in Bernstein form
// (displacement_field.hpp).
//
//   K u = b + F_C,   K_ij = ∫ ε(u_i):A:ε(u_j),   b from body force, tractions and u = u0 on Γ_D
//
// K is symmetric positive definite. On Γ_C the unknowns are normal and tangential coefficients at
// the control points (control_points.hpp), the last ones in their order; without friction the
// tangential ones are inner unknowns. The coefficients inside a triangle (p ≥ 3) are unknowns of
// its element alone, which the factorisation eliminates first. D and G come as in
// stiffness_condensation.hpp, and the contact law is that of every other method, with F_C the
// control points' forces ∫ t B ds.
//
// Curved sides are followed (Problem::round): fields stay polynomials in x, integrated up to the
// curves, and the unknowns on held, rolling and contact sides are traces (curved_traces.hpp), with
// K_d = D⁻ᵀ K D⁻¹ in their triangles.
//
// The displacements are kinematically admissible: u = u0 on Γ_D (u0 is quadratic on every edge) and
// u_n ≤ g0 everywhere on straight contact faces; on curves both hold for the interpolant. The
// stresses balance in the mean only. For ν → ½ these triangles do not lock, but quadratic ones lose
// an order.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "assembly/control_points.hpp"
#include "assembly/nodal_forces.hpp"
#include "solvers/base/element_matrices.hpp"

namespace airybench {

struct DisplacementSystem {
  static constexpr int prescribed = -1;  // or pinned (free_motions.hpp)
  int degree = 2;                        // p
  ControlPoints control;
  PrescribedDisplacement given;  // on curves traces, as `control`
  // Per node: the numbers of its two unknowns, x and y; at control points and on rollers normal and
  // tangential.
  std::vector<std::array<int, 2>> unknown;
  // Control points on a roller: the row of the tangential coefficient, which is prescribed. It
  // stands alone in K, with so large a diagonal that friction does not move it.
  std::map<int, int> held_tangent;
  ElementMatrices K;                              // N/mm
  Eigen::VectorXd b;                              // N, without the contact forces
  int n_c() const { return control.law.size(); }  // the last unknowns
  std::size_t bytes() const;                      // of K, b and what is given
};
// Degrees: those of stresses (stress_degrees.hpp) and one more.
DisplacementSystem assemble_displacement_system(const Problem& problem, int degree);
// Another load case of the same body: replaces b, what is given, and the contact law.
void set_load_case(const Problem& problem, DisplacementSystem& system);

// The coefficients of all nodes, in x and y, from the unknowns.
DisplacementField displacement_field(const Problem& problem, const DisplacementSystem& system,
                                     const Eigen::VectorXd& unknowns);

// What the loads and F_C leave of the nodal forces of the stresses A ε(u), per unknown: not formed
// with K, so that its rounding is seen.
Eigen::VectorXd unbalanced_forces(const Problem& problem, const DisplacementSystem& system,
                                  const NodalForces& of_stresses, const Eigen::VectorXd& F_C);

}  // namespace airybench
