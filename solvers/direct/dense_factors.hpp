// Factors of dense blocks: Cholesky, and the inverse from it; LU.
#pragma once

#include <string>

#include "solvers/base/dense_products.hpp"

namespace airybench {

// L of L Lᵀ = matrix in the lower triangle; what is above means nothing. Throws Breakdown naming
// the block when it is not positive definite to rounding.
Eigen::MatrixXd cholesky(Eigen::MatrixXd matrix, const std::string& name);

// X ← (L Lᵀ)⁻¹ X.
void solve_by_cholesky(const ConstDenseBlock& L, DenseBlock X);

// The first columns of a Cholesky factorisation in place of those of a symmetric matrix, whose
// lower part A has, m × n, m ≥ n:
//
//   ⎡A_1⎤   ⎡L_1⎤     L_1 L_1ᵀ = A_1,  n × n,
//   ⎣A_2⎦ ← ⎣L_2⎦     L_2 = A_2 L_1⁻ᵀ
//
// What is above the diagonal is not read, and lost. Halves of the columns one after the other, down
// to eight (Andersen, Waśniewski & Gustavson 2001, doi:10.1145/383738.383741), so that nearly all
// of it are matrix products: OpenBLAS has dtrsm at a third of dgemm's rate on AVX-512. False: not
// positive definite to rounding, or not finite.
bool factorise_in_place(DenseBlock A);

// (L Lᵀ)⁻¹, exactly symmetric, from the lower triangle of L. Throws Breakdown where L has a zero on
// its diagonal.
Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L);

// A⁻¹ b by LU with partial pivoting, large ones in float and refined, in double where that does not
// settle (dsgesv: Langou et al. 2006, doi:10.1145/1188455.1188573); not finite where A is singular.
Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b);

}  // namespace airybench
