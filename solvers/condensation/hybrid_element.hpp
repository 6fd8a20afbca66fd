// One triangle of the hybridized system (hybridized.hpp), in any scalar: what goes in and comes out
// for stresses of every degree k, and how for k = 1; degree_element.hpp has the others.
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

#include "assembly/equilibrium_element.hpp"
#include "assembly/problem.hpp"
#include "assembly/small_cholesky.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

// What an element is made from. Its unknowns are, per edge and moment, two components of ū.
template <typename Scalar, int k = 1>
struct HybridInput {
  Data<Scalar> vertices[6];        // TriangleVertices
  Data<Scalar> compliance[9];      // C
  Scalar from_start[3];            // 1: an edge's moments follow the element's walk; 0: reversed
  Scalar components[3][k + 1][4];  // per edge and moment: the two components' directions
  Scalar particular[9];            // σ_p at the vertices
};

template <typename Scalar, int k = 1>
struct HybridStiffness {
  static constexpr int size = StressDegree<k>::size;
  Scalar lower[size * (size + 1) / 2];  // K_e's lower triangle, N/mm
  Scalar load[size];                    // f_e, N
  Scalar independence;  // of the stresses: S_e is positive definite if it is above rounding
};

template <typename Scalar, int k = 1>
struct HybridStress {
  Scalar stress[3 * StressDegree<k>::coefficients];  // the total stress that ū_e makes, MPa
  Scalar forces[StressDegree<k>::size];              // of that stress on the edges, N
  // g_e = T_eᵀ ū_e − ∫ σ(φ_i):C:σ is zero for the stress that ū_e makes, but for rounding, that of
  // S_e and its factor, too, which are not in it. The correction S_e⁻¹ g_e of φ_e has
  Scalar defect[StressDegree<k>::size];  // the forces T_e S_e⁻¹ g_e, N
  Scalar defect_energy;                  // and the energy g_eᵀ S_e⁻¹ g_e, N mm
};

// rows: per edge (rows_in_frame).
template <typename Scalar, int k = 1>
HybridInput<Scalar, k> hybrid_input(const Problem& problem, const std::vector<int>& rows,
                                    int triangle);

template <typename Scalar>
struct HybridElement {
  HctStressIn<Scalar, 9> stress;
  Scalar area;                                     // mm²
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

}  // namespace airybench
