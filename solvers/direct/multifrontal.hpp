// Multifrontal Cholesky factorisation of a sum of element matrices (Duff & Reid 1983,
// doi:10.1145/356044.356047; Liu 1992, doi:10.1137/1034004), symmetric positive definite:
//
//   P K Pᵀ = L Lᵀ,  P from elimination.hpp
//
// A front is a dense matrix over its pivots and the rows below them. Into it go the elements whose
// first pivot it has, and what its children left; its pivots are eliminated,
//
//   ⎡ F_11  ·   ⎤     L_11 L_11ᵀ = F_11,  L_21 = F_21 L_11⁻ᵀ,  U = F_22 − L_21 L_21ᵀ,
//   ⎣ F_21 F_22 ⎦
//
// and U goes to its parent. K itself is never stored, and all work on large fronts is BLAS's. The
// last `trailing` unknowns C stay last in their order, so that L ends in the factor of a Schur
// complement, K_CC − K_CI K_II⁻¹ K_IC = L_CC L_CCᵀ.
#pragma once

#include <memory>

#include "solvers/base/solution.hpp"
#include "solvers/direct/elimination.hpp"

namespace airybench {

class MultifrontalFactor {
 public:
  // The symbolic half. Throws std::bad_alloc.
  void analyse(const ElementMatrices& K, int trailing = 0);
  // Of the matrix that was analysed, or another on the same elements. Throws Breakdown when it is
  // not positive definite or not finite, TimeoutReached, std::bad_alloc.
  void factor(const ElementMatrices& K, const Deadline& deadline = {});
  // The same for a preconditioner, computed in double and kept in float: half the memory, and half
  // as much to read in a solve. An energy |Lᵀv|² moves by about 2⁻²⁴ √cond K of itself, that of the
  // softest modes most. These are what z = (L Lᵀ)⁻¹ r has, r random: doubles are kept after all
  // where |1 − zᵀK z / zᵀr| > 0.1.
  void factor_rounded(const ElementMatrices& K, const Deadline& deadline = {});
  bool rounded() const { return rounded_ != nullptr; }

  // X ← K⁻¹ X. Throws TimeoutReached.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline = {}) const;

  // y = L⁻¹ P b and Pᵀ L⁻ᵀ z: the halves of a solve. In y and z the trailing unknowns are the last
  // ones too; the inner ones are in the factor's order. By the inner columns only, the last part of
  // y is  b_C − K_CI K_II⁻¹ b_I,  and that of z is the solution's.
  enum class Columns { all, inner };
  Eigen::VectorXd forward(const Eigen::VectorXd& b, Columns columns = Columns::all) const;
  Eigen::VectorXd backward(const Eigen::VectorXd& z, Columns columns = Columns::all) const;
  Eigen::MatrixXd trailing_factor() const;  // L_CC, lower triangular

  std::size_t bytes() const;     // of L and its structure
  std::int64_t entries() const;  // of L, with the zeros that fronts store
  double flops() const;          // of the numeric factorisation

 private:
  template <typename Visit>
  auto visit_panels(Visit visit) const {
    return rounded() ? visit(static_cast<const float*>(rounded_.get()))
                     : visit(static_cast<const double*>(panels_.get()));
  }
  int end(Columns columns) const;
  double error_in_soft_modes(const ElementMatrices& K) const;

  Elimination elimination_;
  std::unique_ptr<double[]> panels_;  // of all fronts, rows × pivots each
  std::unique_ptr<float[]> rounded_;  // the same instead
};

}  // namespace airybench
