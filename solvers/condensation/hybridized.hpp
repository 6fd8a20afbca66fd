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
// D, G and F_C are the same numbers as from the Airy system, without its ill-conditioning: the
// scaled condition number grows like h⁻², not h⁻⁴. No gauge, no multipliers.
#pragma once

#include <array>
#include <vector>

#include "assembly/dual_system.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/solution.hpp"

namespace airybench {

struct HybridizedSystem {
  static constexpr int prescribed = -1;
  // Per edge: the numbers of its four unknowns, x and y at its low vertex, x and y at its high one;
  // on Γ_C normal and tangential at its start and end. Inner unknowns first, then the contact rows
  // in the order of ContactPoints (without friction the tangential ones are inner unknowns).
  std::vector<std::array<int, 4>> unknown;
  std::vector<Eigen::Vector4d> displacement;  // ū0 of displacement edges, else 0; empty: all zero
  SparseColumns K;                            // lower triangle, N/mm
  Eigen::VectorXd b;                          // N, without the contact forces
  int n_c = 0;                                // the last unknowns
  std::size_t bytes() const;                  // of K and b
};

// `contact` is that of the Airy system: it says which contact unknowns there are. Throws Breakdown
// naming the triangle whose flexibility is not positive definite to rounding.
HybridizedSystem assemble_hybridized(const Problem& problem, const ContactPoints& contact);

// The stresses that belong to contact displacements ū_C (size n_c).
StressField hybridized_stress(const Problem& problem, const HybridizedSystem& system,
                              StiffnessFactor& factor, const Eigen::VectorXd& contact_displacement);

}  // namespace airybench
