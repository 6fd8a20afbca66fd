// Hybridized equilibrium elements: the same discrete stresses as the Airy system, from a symmetric
// positive definite system in edge displacements (Fraeijs de Veubeke 1965; Johnson & Mercier 1978,
// doi:10.1007/BF01403910).
//
// Per triangle, S_e is the flexibility of hct.hpp and T_e (12×12) maps its unknowns to the
// generalised forces on its three edges, x and y at both ends, outward. Both vanish on affine φ;
// with the three unknowns of one vertex removed
//
//   K_e = T_e S_e⁻¹ T_eᵀ     12×12 stiffness, rank 9 = 12 − 3 rigid motions
//   F_e = K_e ū_e + f_e,     f_e = F_p − T_e S_e⁻¹ p_e from the body force's particular stress
//
// where p_e = ∫ σ(φ_i):C:σ_p. Edge forces balance: Σ_e F_e = 0 inside, F on Γ_F, F_C on Γ_C, and
// ū is prescribed on Γ_D. Contact displacements are the last unknowns, and D and G come as in
// stiffness_condensation.hpp.
//
// Stresses of degree k (equilibrium_element.hpp) have k + 1 moments per edge, and the contact law
// holds at the Bernstein control values of a contact edge's traction: these in the cone, σ_n ≤ 0
// and |σ_t| ≤ −μ σ_n hold on the whole edge. Gap and ū0 are quadratic on edges, and so exact.
//
// Thermal strain displaces a triangle's edges against ū by u_th (thermal_strain.hpp):
// F_e = K_e (ū_e − ū_th) + f_e.
//
// D, G and F_C are the same numbers as from the Airy system, without its ill-conditioning: the
// scaled condition number grows like h⁻², not h⁻⁴. No gauge, no multipliers.
//
// Templates over the scalar are instantiated for double and Wide: HYBRID works in
// double, the reference refines in Wide (refinement.hpp); tests check both in 128 bits. The
// data are doubles in all of them: coordinates, compliances, ū0, forces on Γ_F.
#pragma once

#include <vector>

#include "assembly/contact_system.hpp"
#include "solvers/base/element_matrices.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/edge_unknowns.hpp"
#include "solvers/condensation/stiffness_check.hpp"

namespace airybench {

template <typename Scalar>
struct HybridizedSystemIn {
  EdgeUnknowns unknown;
  Eigen::MatrixXd displacement;                            // prescribed_displacements()
  Eigen::MatrixXd thermal;                                 // thermal_moments()
  ElementMatricesIn<Scalar> K;                             // N/mm
  Eigen::VectorX<Scalar> b;                                // N, without the contact forces
  int n_c = 0;                                             // the last unknowns
  int degree() const { return unknown.length() / 2 - 1; }  // of the stresses
  std::size_t bytes() const;                               // of K and b
};
using HybridizedSystem = HybridizedSystemIn<double>;

// `contact` is contact_points() of a degree: it says that of the stresses and which contact
// unknowns there are. Throws Breakdown naming the triangle whose flexibility is not positive
// definite to rounding.
template <typename Scalar = double>
HybridizedSystemIn<Scalar> assemble_hybridized(const Problem& problem,
                                               const ContactPoints& contact);

// Another load case of the same body: replaces b and ū0. With a body force it computes all f_e
// again.
template <typename Scalar>
void set_load_case(const Problem& problem, HybridizedSystemIn<Scalar>& system);

// K (ū0 − ū_th) at the unknowns, N, which is not in b any more, and its work on ū0 − ū_th, N mm.
template <typename Scalar>
struct PrescribedForces {
  Eigen::VectorX<Scalar> forces;  // empty: all zero
  Scalar energy = 0;
};
template <typename Scalar>
PrescribedForces<Scalar> prescribed_forces(const Problem& problem,
                                           const HybridizedSystemIn<Scalar>& system);

// The stresses that belong to u: computed in Scalar, rounded at the end.
template <typename Scalar>
StressField hybridized_stress(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u);

// Stresses of u, and how far each is from what its edges' displacements ask of it, g_e of
// hybrid_element.hpp. K is not asked for.
struct HybridizedAnswer {
  StressField stress;
  UnbalancedForces unbalanced;  // by the stresses and the tractions on Γ_F; without F_C
};
HybridizedAnswer recover_stresses(const Problem& problem, const HybridizedSystem& system,
                                  const Eigen::VectorXd& u);

}  // namespace airybench
