// Dense systems without symmetry, by LAPACK.
#pragma once

#include <Eigen/Core>

namespace airybench {

// A⁻¹ b by LU with partial pivoting; not finite where A is singular.
Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b);

}  // namespace airybench
