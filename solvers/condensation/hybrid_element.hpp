// One triangle of the hybridized system (hybridized.hpp) with stresses of degree k
// (equilibrium_element.hpp), in any scalar: what goes in and comes out.
//
//   S_e φ_e = T_eᵀ ū_e − p_e,   F_e = T_e φ_e + F_p   ⇒   F_e = K_e ū_e + f_e
//   K_e = T_e S_e⁻¹ T_eᵀ,       f_e = F_p − T_e S_e⁻¹ p_e
//
// Edge components are those of EdgeUnknowns. K_e = RᵀR with R = L⁻¹T_eᵀ, S_e = LLᵀ: it is positive
// semidefinite to rounding.
//
// What goes in and what comes out are plain arrays, matrices by columns, so that elements in double
// can be gathered into packs (hybrid_kernels.hpp).
#pragma once

#include <vector>

#include "assembly/elements/equilibrium_element.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

// What an element is made from. Its unknowns are, per edge and moment, two components of ū.
template <typename Scalar, int k>
struct HybridInput {
  Data<Scalar> vertices[6];        // TriangleVertices
  Data<Scalar> compliance[9];      // C
  Scalar from_start[3];            // 1: an edge's moments follow the element's walk; 0: reversed
  Scalar components[3][k + 1][4];  // per edge and moment: the two components' directions
  Scalar particular[9];            // σ_p at the vertices
};

template <typename Scalar, int k>
struct HybridStiffness {
  static constexpr int size = StressDegree<k>::size;
  Scalar lower[size * (size + 1) / 2];  // K_e's lower triangle, N/mm
  Scalar load[size];                    // f_e, N
  Scalar independence;  // of the stresses: S_e is positive definite if it is above rounding
};

template <typename Scalar, int k>
struct HybridStress {
  Scalar stress[3 * StressDegree<k>::coefficients];  // the total stress that ū_e makes, MPa
  Scalar forces[StressDegree<k>::size];              // of that stress on the edges, N
  // g_e = T_eᵀ ū_e − ∫ σ(φ_i):C:σ is zero for the stress that ū_e makes, but for rounding, that of
  // S_e and its factor, too, which are not in it. The correction S_e⁻¹ g_e of φ_e has
  Scalar defect[StressDegree<k>::size];  // the forces T_e S_e⁻¹ g_e, N
  Scalar defect_energy;                  // and the energy g_eᵀ S_e⁻¹ g_e, N mm
};

// rows: per edge (rows_in_frame).
template <typename Scalar, int k>
HybridInput<Scalar, k> hybrid_input(const Problem& problem, const std::vector<int>& rows,
                                    int triangle);

template <typename Scalar, int k>
HybridStiffness<Scalar, k> hybrid_stiffness(const HybridInput<Scalar, k>& input, bool loaded);
template <typename Scalar, int k>
HybridStress<Scalar, k> hybrid_stress(const HybridInput<Scalar, k>& input, bool loaded,
                                      typename EquilibriumElement<Scalar, k>::OnEdges displacement);

}  // namespace airybench
