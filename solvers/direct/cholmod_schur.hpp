// Cholesky factorisation whose last unknowns stay last, so that it ends in a Schur complement.
//
//   ⎡ K_II  ·   ⎤     ⎡ L_II      ⎤ ⎡ L_IIᵀ L_CIᵀ ⎤
//   ⎣ K_CI K_CC ⎦  =  ⎣ L_CI L_CC ⎦ ⎣       L_CCᵀ ⎦      K_CC − K_CI K_II⁻¹ K_CI ᵀ = L_CC L_CCᵀ
//
// (I permuted to reduce fill). The Schur complement's factor L_CC is there with no solve. By
// CHOLMOD's supernodal factorisation; K is symmetric positive definite.
#pragma once

#include <cholmod.h>

#include <Eigen/SparseCore>
#include <memory>

#include "solvers/solution.hpp"

namespace airybench {

class CholmodSchur {
 public:
  CholmodSchur();
  ~CholmodSchur();
  CholmodSchur(const CholmodSchur&) = delete;
  CholmodSchur& operator=(const CholmodSchur&) = delete;

  // Ordering and symbolic factorisation of a lower triangle with sorted columns; the last
  // `trailing` unknowns keep their place and order. Throws std::bad_alloc.
  void analyse(const Eigen::SparseMatrix<double>& lower, int trailing);
  // Throws Breakdown when K is not positive definite, std::bad_alloc.
  void factor(const Eigen::SparseMatrix<double>& lower);

  Eigen::MatrixXd trailing_factor() const;  // L_CC, lower triangular

  // y = L⁻¹ P b and P ᵀ L⁻ᵀ z: the halves of a solve. In y and z the trailing unknowns are the last
  // ones too; the inner ones are in the factor's order.
  Eigen::VectorXd forward(const Eigen::VectorXd& b);
  Eigen::VectorXd backward(const Eigen::VectorXd& z);

  std::size_t bytes() const;  // of L as it is stored

 private:
  Eigen::VectorXd solve(int part, const Eigen::VectorXd& b);
  void throw_if_out_of_memory() const;
  mutable cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
  int trailing_ = 0;
};

}  // namespace airybench
