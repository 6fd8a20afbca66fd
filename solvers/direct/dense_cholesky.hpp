// Cholesky factorisation of a dense block, by Eigen.
#pragma once

#include <Eigen/Cholesky>
#include <string>

namespace airybench {

// Throws Breakdown naming the block when it is not positive definite to rounding.
Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name);

}  // namespace airybench
