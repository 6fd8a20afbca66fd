// Dense systems without symmetry, by LAPACK.
#pragma once

#include <Eigen/Core>

namespace airybench {

// A⁻¹ b by LU with partial pivoting, large ones in float and refined, in double where that does not
// settle (dsgesv: Langou et al. 2006, doi:10.1145/1188455.1188573); not finite where A is singular.
Eigen::VectorXd solve_by_lu(Eigen::MatrixXd A, Eigen::VectorXd b);

}  // namespace airybench
