// One triangle of the hybridized system (hybridized.hpp), in any scalar.
//
//   S_e φ_e = T_eᵀ ū_e − p_e,   F_e = T_e φ_e + F_p   ⇒   F_e = K_e ū_e + f_e
//   K_e = T_e S_e⁻¹ T_eᵀ,       f_e = F_p − T_e S_e⁻¹ p_e
//
// over the nine unknowns φ_e that are left when vertex 1's three are dropped. Edge components are
// those of EdgeUnknowns. K_e = RᵀR with R = L⁻¹T_eᵀ, S_e = LLᵀ from the
// stresses themselves (SmallCholesky::of_root): it is positive semidefinite to rounding.
//
// What goes in and what comes out are plain arrays, matrices by columns, so that elements in double
// can be gathered into packs (hybrid_kernels.hpp).
#pragma once

#include <vector>

#include "assembly/problem.hpp"
#include "assembly/small_cholesky.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

// What an element is made from.
template <typename Scalar>
struct HybridInput {
  Data<Scalar> vertices[6];    // TriangleVertices
  Data<Scalar> outward[3];     // EdgeSigns
  Data<Scalar> compliance[9];  // C
  Scalar area;                 // mm²
  Scalar components[3][16];    // per edge: edge_components
  Scalar particular[27];       // σ_p
};

template <typename Scalar>
struct HybridStiffness {
  Scalar lower[78];     // K_e's lower triangle, N/mm
  Scalar load[12];      // f_e, N
  Scalar independence;  // of the stresses: S_e is positive definite if it is above rounding
};

template <typename Scalar>
struct HybridStress {
  Scalar stress[27];  // ElementStress: the total stress that ū_e makes, MPa
  Scalar forces[12];  // of that stress on the edges, N
  // g_e = T_eᵀ ū_e − ∫ σ(φ_i):C:σ is zero for the stress that ū_e makes, but for rounding, that of
  // S_e and its factor, too, which are not in it. The correction S_e⁻¹ g_e of φ_e has
  Scalar defect[12];     // the forces T_e S_e⁻¹ g_e, N
  Scalar defect_energy;  // and the energy g_eᵀ S_e⁻¹ g_e, N mm
};

template <typename Scalar>
struct HybridElement {
  HctStressIn<Scalar, 9> stress;
  SmallCholesky<Scalar, 9> flexibility;            // S_e, factorised
  Eigen::Matrix<Scalar, 9, 12> forces;             // T_eᵀ
  bool loaded;                                     // by a body force; else the rest is zero
  ElementStressIn<Scalar> particular;              // σ_p
  Eigen::Matrix<Scalar, 9, 1> particular_load;     // p_e
  Eigen::Matrix<Scalar, 12, 1> particular_forces;  // F_p
};

template <typename Scalar>
HybridElement<Scalar> make_hybrid_element(const HybridInput<Scalar>& input, bool loaded);
template <typename Scalar>
HybridStiffness<Scalar> hybrid_stiffness(const HybridInput<Scalar>& input, bool loaded);
template <typename Scalar>
HybridStress<Scalar> hybrid_stress(const HybridInput<Scalar>& input, bool loaded,
                                   const Eigen::Matrix<Scalar, 12, 1>& displacement);

// rows: per edge (rows_in_frame).
template <typename Scalar>
HybridInput<Scalar> hybrid_input(const Problem& problem, const std::vector<int>& rows,
                                 int triangle);

}  // namespace airybench
