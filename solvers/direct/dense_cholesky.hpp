// Cholesky factorisation of a dense block, and the inverse from it.
#pragma once

#include <Eigen/Cholesky>
#include <string>

namespace airybench {

// Throws Breakdown naming the block when it is not positive definite to rounding.
Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name);

// A = L Lᵀ in its lower triangle, on the processor's kernels; what is above stays. False: not
// positive definite to rounding, or not finite.
bool factorise_in_place(Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> A);

// (L Lᵀ)⁻¹, exactly symmetric, from the lower triangle of L. Throws Breakdown where L has a zero on
// its diagonal.
Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L);

}  // namespace airybench
