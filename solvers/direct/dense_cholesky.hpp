// Cholesky factorisation of a dense block, by Eigen, and the inverse from it, by LAPACK.
#pragma once

#include <Eigen/Cholesky>
#include <string>

namespace airybench {

// Throws Breakdown naming the block when it is not positive definite to rounding.
Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name);

// (L Lᵀ)⁻¹, exactly symmetric, from the lower triangle of L. Throws Breakdown where L has a zero on
// its diagonal.
Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L);

}  // namespace airybench
