// The discrete contact problem in the Airy function, the paper's eq. (4):
//
//   ⎡ S   C_Fᵀ C_Cᵀ  0 ⎤ ⎡ φ  ⎤   ⎡ q   ⎤     S    n×n      ∫ σ(φ_i):C:σ(φ_j), N⁻¹ mm …
//   ⎢ C_F  0    0    0 ⎥ ⎢ λ  ⎥ = ⎢ F   ⎥     C_F  n_f×n    forces on Γ_F, x and y …
//   ⎢ C_C  0    0   −I ⎥ ⎢ λ' ⎥   ⎢ −F0 ⎥     C_C  n_c×n    forces on Γ_C, normal and tangential
//   ⎣ 0    0   −I    0 ⎦ ⎣ F_C⎦   ⎣ ū_C ⎦     λ' = −ū_C    contact displacements, mm
//
// with the contact law between F_C and ū_C (contact_system.hpp).
//
// The unknown here is x = φ/scale: S is equilibrated to the diagonal 1; q, C_F and C_C are scaled
// alike. Rows are numbered by Cuthill–McKee without the gauge, so n = n_φ − 3, S is symmetric
// positive definite, and C = [C_F; C_C] has full rank.
//
// Blocks that a scene does not need are not built: an empty vector is zero. Without friction the
// tangential contact forces are prescribed as zero; their rows follow those of Γ_F in C_F. The
// tangential forces on rollers, also zero, come last. At a pin (free_motions.hpp) C_F has no row.
#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "assembly/contact_system.hpp"
#include "assembly/dof_numbering.hpp"

namespace airybench {

using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor>;

// Of degree 1.
struct AirySystem : ContactSystem {
  DofNumbering dofs;
  Eigen::VectorXd scale;  // φ = scale ∘ x
  SparseColumns S;        // lower triangle
  SparseRows C_F, C_C;
  Eigen::VectorXd q;   // empty: zero
  Eigen::VectorXd F;   // N; empty: zero
  Eigen::VectorXd F0;  // N, contact forces of the particular stress; empty: zero

  int n() const { return static_cast<int>(S.rows()); }
  int n_f() const { return static_cast<int>(C_F.rows()); }
  std::size_t bytes() const override;
  // Rebuilds q, F, F0 and the constraints, keeps S. Costs the boundary, and with a body force a
  // pass over the triangles.
  void set_load_case(std::shared_ptr<const Problem> load_case) override;
};

// Why a body has none; empty: it has. Around a hole whose forces have a resultant or a moment φ
// changes by an affine function (Michell 1899): three unknowns per hole that are not here. Without
// them a hole's rows of C are dependent.
std::string why_no_airy_function(const Problem& problem);
// Throws std::invalid_argument with the reason of why_no_airy_function().
AirySystem airy_system(std::shared_ptr<const Problem> problem);

// From x to φ, φ,x, φ,y of every vertex, then ∂φ/∂n of every edge (3V + E values).
Eigen::VectorXd airy_function(const AirySystem& system, const Eigen::VectorXd& x);

}  // namespace airybench
