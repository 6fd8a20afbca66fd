// The discrete contact problem in the Airy function, the paper's eq. (4):
//
//   ⎡ S   C_Fᵀ C_Cᵀ  0 ⎤ ⎡ φ  ⎤   ⎡ q   ⎤     S    n×n      ∫ σ(φ_i):C:σ(φ_j), N⁻¹ mm …
//   ⎢ C_F  0    0    0 ⎥ ⎢ λ  ⎥ = ⎢ F   ⎥     C_F  n_f×n    forces on Γ_F, x and y …
//   ⎢ C_C  0    0   −I ⎥ ⎢ λ' ⎥   ⎢ −F0 ⎥     C_C  n_c×n    forces on Γ_C, normal and tangential
//   ⎣ 0    0   −I    0 ⎦ ⎣ F_C⎦   ⎣ ū_C ⎦     λ' = −ū_C    contact displacements, mm
//
// with the contact law (contact_problem.hpp) between F_C and r = ū_C − ḡ at every contact point,
// two per edge, its ends (k + 1 for stresses of degree k). ū_C belongs to w; ḡ contains g0 and the
// rigid motion (problem.hpp).
//
// edge_forces.hpp defines forces and displacements on edges. The unknown here is x = φ/scale: S is
// equilibrated to the diagonal 1; q, C_F and C_C are scaled alike. Rows are numbered by
// Cuthill–McKee without the gauge, so n = n_φ − 3, S is symmetric positive definite, and C = [C_F;
// C_C] has full rank.
//
// Blocks that a scene does not need are not built: an empty vector is zero. Without friction the
// tangential contact forces are prescribed as zero; their rows follow those of Γ_F in C_F. The
// tangential forces on rollers, also zero, come last. At a pin (free_motions.hpp) C_F has no row.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "assembly/contact_problem.hpp"
#include "assembly/dof_numbering.hpp"
#include "assembly/problem/problem.hpp"
#include "support/wide.hpp"

namespace airybench {

using WideVector = Eigen::VectorX<Wide>;
using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor>;

// degree: of the stresses, k + 1 points per edge. Two components if there is friction anywhere; ḡ
// from the moments of the offset.
ContactPoints contact_points(const Problem& problem, int degree = 1);

struct DualSystem {
  std::shared_ptr<const Problem> problem;
  int degree = 1;  // of the stresses; above 1 there are contact points only
  DofNumbering dofs;
  Eigen::VectorXd scale;  // φ = scale ∘ x
  SparseColumns S;        // lower triangle
  SparseRows C_F, C_C;
  Eigen::VectorXd q;   // empty: zero
  Eigen::VectorXd F;   // N; empty: zero
  Eigen::VectorXd F0;  // N, contact forces of the particular stress; empty: zero
  ContactPoints contact;

  int n() const { return static_cast<int>(S.rows()); }
  int n_f() const { return static_cast<int>(C_F.rows()); }
  int n_c() const { return static_cast<int>(C_C.rows()); }
  std::size_t bytes() const;  // of all blocks
};

// The blocks that a method needs; contact_points leaves the rest empty.
enum class Blocks { airy, contact_points };
// Why a body lacks these blocks; empty: it has them. Around a hole whose forces have a resultant or
// a moment φ changes by an affine function (Michell 1899): three unknowns per hole that are not
// here. Without them a hole's rows of C are dependent.
std::string why_no_blocks(const Problem& problem, Blocks blocks);
// Throws std::invalid_argument with the reason of why_no_blocks(). degree: of the stresses; above 1
// only with Blocks::contact_points.
DualSystem assemble(std::shared_ptr<const Problem> problem, Blocks blocks = Blocks::airy,
                    int degree = 1);
// Another load case of the same body (same_body): rebuilds q, F, F0 and the contact points, keeps
// S. Costs the boundary, and with a body force a pass over the triangles.
void set_load_case(DualSystem& system, std::shared_ptr<const Problem> problem);

// From x to φ, φ,x, φ,y of every vertex, then ∂φ/∂n of every edge (3V + E values).
Eigen::VectorXd airy_function(const DualSystem& system, const Eigen::VectorXd& x);

}  // namespace airybench
