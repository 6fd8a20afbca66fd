// Multifrontal LDLᵀ factorisation by sequential MUMPS (Amestoy, Duff, L'Excellent & Koster 2001,
// doi:10.1137/S0895479899358194).
//
//   P A Pᵀ = L D Lᵀ, D of 1×1 and 2×2 blocks, with threshold pivoting inside the fronts; where
// the caller says that A is positive definite, D is diagonal and nothing is pivoted. On request the
// last unknowns C are not eliminated, and what is left of them is their Schur complement:
//
//   A = ⎡ A_II A_CIᵀ ⎤       schur() = A_CC − A_CI A_II⁻¹ A_CIᵀ
//       ⎣ A_CI A_CC  ⎦       reduce(b) = b_C − A_CI A_II⁻¹ b_I
#pragma once

#include <dmumps_c.h>

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "solvers/base/solution.hpp"

namespace airybench {

class MumpsFactor {
 public:
  // Columns solved together: enough for matrix products, few enough for little workspace.
  static constexpr int columns_at_once = 64;

  enum class Definite { no, yes };
  explicit MumpsFactor(Definite definite = Definite::no);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  // Ordering and symbolic factorisation of a lower triangle in compressed columns, which is also
  // looked at for its values (scaling, 2×2 pivots). The last `trailing` unknowns are those of the
  // Schur complement. Throws Breakdown when it is not finite, std::bad_alloc.
  void analyse(const Eigen::SparseMatrix<double>& lower, int trailing = 0);
  // Of the matrix that was analysed. Throws Breakdown when it is singular, not finite or
  // not definite as promised, std::bad_alloc.
  void factor(const Eigen::SparseMatrix<double>& lower);

  // X ← A⁻¹ X, a few columns at a time; without trailing unknowns. Throws TimeoutReached between
  // them, std::bad_alloc.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline = {});

  const Eigen::MatrixXd& schur() const { return schur_; }  // symmetric
  // To work in its place: schur() is empty then, and nothing is factorised again.
  Eigen::MatrixXd take_schur() { return std::move(schur_); }
  // The right-hand side that belongs to schur(); then, once and of the same b, the whole solution
  // from its trailing part x_C.
  Eigen::VectorXd reduce(const Eigen::VectorXd& b);
  Eigen::VectorXd expand(const Eigen::VectorXd& x_C);

  int negative_pivots() const;  // of D: negative eigenvalues of A, or of A_II
  // Of what it keeps: the workspace that L and D are left in, which is larger than they are by what
  // the fronts needed, indices, the entries' rows and columns, schur().
  std::size_t bytes() const;
  std::int64_t entries() const;  // of L and D
  double flops() const;          // of the numeric factorisation

 private:
  void call(int job, const char* doing);
  void solve(int kind, Eigen::Ref<Eigen::MatrixXd> X);
  DMUMPS_STRUC_C mumps_{};
  std::vector<int> rows_, columns_;  // of the entries, from 1
  Eigen::MatrixXd schur_;
};

}  // namespace airybench
