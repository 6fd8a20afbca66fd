// Supernodal Cholesky factorisation by CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008,
// doi:10.1145/1391989.1391995), through Eigen's wrapper.
//
// S P = P L Lᵀ with a fill-reducing permutation P that CHOLMOD chooses (AMD, or METIS where AMD
// leaves much fill). S is symmetric positive definite.
#pragma once

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include "solvers/solution.hpp"

namespace airybench {

class CholmodFactor {
 public:
  CholmodFactor();
  // Ordering and symbolic factorisation of a lower triangle. Throws std::bad_alloc.
  void analyse(const Eigen::SparseMatrix<double>& lower);
  // Of the matrix that was analysed, or one with its pattern. Throws Breakdown when it is not
  // positive definite, std::bad_alloc.
  void factor(const Eigen::SparseMatrix<double>& lower);

  // X ← S⁻¹ X, a few columns at a time. Throws TimeoutReached between them, std::bad_alloc.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline = {});

  std::size_t bytes() const { return bytes_; }  // of L, by CHOLMOD's count of its entries

 private:
  void throw_if_out_of_memory();
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> llt_;
  std::size_t bytes_ = 0;
};

}  // namespace airybench
