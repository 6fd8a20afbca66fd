// One triangle of the hybridized system (hybridized.hpp), in double or long double.
//
//   S_e φ_e = T_eᵀ ū_e − p_e,   F_e = T_e φ_e + F_p   ⇒   F_e = K_e ū_e + f_e
//   K_e = T_e S_e⁻¹ T_eᵀ,       f_e = F_p − T_e S_e⁻¹ p_e
//
// over the nine unknowns φ_e that are left when vertex 1's three are dropped. Edge components are
// those of EdgeUnknowns. K_e = RᵀR with R = L⁻¹T_eᵀ, S_e = LLᵀ: it is positive
// semidefinite to rounding.
#pragma once

#include <vector>

#include "assembly/problem.hpp"
#include "assembly/small_cholesky.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

template <typename Scalar>
struct HybridElement {
  HctStressIn<Scalar> stress;                      // of all twelve unknowns
  SmallCholesky<Scalar, 9> flexibility;            // S_e, factorised
  Eigen::Matrix<Scalar, 9, 12> forces;             // T_eᵀ
  bool loaded = false;                             // by a body force; else the rest is zero
  ElementStressIn<Scalar> particular;              // σ_p
  Eigen::Matrix<Scalar, 9, 1> particular_load;     // p_e
  Eigen::Matrix<Scalar, 12, 1> particular_forces;  // F_p

  Eigen::Matrix<Scalar, 12, 12> stiffness() const;  // K_e
  Eigen::Matrix<Scalar, 12, 1> load() const;        // f_e
  ElementStressIn<Scalar> stress_at(
      const Eigen::Matrix<Scalar, 12, 1>& displacement) const;  // the total stress that ū_e makes
  // T_eᵀ ū_e − ∫ σ(φ_i):C:σ: zero for the stress that ū_e makes, but for rounding, that of S_e and
  // its factor, too, which are not in it. mm
  Eigen::Matrix<Scalar, 9, 1> incompatibility(const Problem& problem, int triangle,
                                              const Eigen::Matrix<Scalar, 12, 1>& displacement,
                                              const ElementStressIn<Scalar>& total) const;
};

// How the components of EdgeUnknowns make an element's edge components: x, y at the
// start and at the end of its walk along edge k.
template <typename Scalar = double>
Eigen::Matrix4<Scalar> edge_components(const Mesh& mesh, int triangle, int k, bool in_frame);

// in_frame: per edge (edges_in_frame). Throws Breakdown naming the triangle whose flexibility is
// not positive definite to rounding.
template <typename Scalar>
HybridElement<Scalar> make_hybrid_element(const Problem& problem, const std::vector<bool>& in_frame,
                                          int triangle);

}  // namespace airybench
