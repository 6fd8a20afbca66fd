// Supernodal Cholesky factorisation by CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008,
// doi:10.1145/1391989.1391995), symmetric positive definite.
//
//   P S Pᵀ = L Lᵀ with a fill-reducing permutation P that CHOLMOD chooses (AMD, or METIS where AMD
// leaves much fill). On request the last unknowns C come after all others that they
// depend on, and their part of L is the factor of their Schur complement,
// S_CC − S_CI S_II⁻¹ S_IC = L_CC L_CCᵀ.
#pragma once

#include <cholmod.h>

#include <Eigen/SparseCore>
#include <vector>

#include "solvers/base/solution.hpp"

namespace airybench {

class CholmodFactor {
 public:
  CholmodFactor();
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  // Ordering and symbolic factorisation of a lower triangle with sorted columns. The last
  // `trailing` unknowns are C. Throws std::bad_alloc.
  void analyse(const Eigen::SparseMatrix<double>& lower, int trailing = 0);
  // Of the matrix that was analysed, or one with its pattern. Throws Breakdown when it is not
  // positive definite or not finite, std::bad_alloc.
  void factor(const Eigen::SparseMatrix<double>& lower);

  // X ← S⁻¹ X, a few columns at a time. Throws TimeoutReached between them, std::bad_alloc.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline = {});

  // (L_CC L_CCᵀ)⁻¹.
  Eigen::MatrixXd inverse_of_schur() const;

  std::size_t bytes() const;     // of L as it is stored, its permutation and the workspace
  std::int64_t entries() const;  // of L, without the supernodes' padding
  double flops() const;          // of the numeric factorisation

 private:
  std::vector<int> order_with_last(const Eigen::SparseMatrix<double>& lower, int trailing);
  void free_workspace();
  void solve(Eigen::Ref<Eigen::MatrixXd> X);
  void throw_if_out_of_memory() const;
  cholmod_common common_;
  int trailing_ = 0;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *permuted_ = nullptr, *gathered_ = nullptr;  // workspace
};

}  // namespace airybench
