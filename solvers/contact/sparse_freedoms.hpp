// The linear system of an active set (active_set.hpp) where D is sparse or not formed. With P the
// forces of the freedoms, n_c × freedoms, and Q their relations,
//
//   (Q D P + diag) z = b,      or      ⎡ M      −H P ⎤ ⎡ v ⎤   ⎡ 0 ⎤
//                                      ⎣ Q Hᵀ   diag ⎦ ⎣ z ⎦ = ⎣ b ⎦    of D = Hᵀ M⁻¹ H
//
// by sparse LU (solvers/direct/sparse_lu.hpp).
#pragma once

#include "solvers/contact/freedoms.hpp"

namespace airybench {

// z, with what freedoms[k].diagonal has. Not finite where the matrix is singular.
Eigen::VectorXd solve_sparse_freedoms(const contact::Problem& problem,
                                      const std::vector<Freedom>& freedoms,
                                      const Eigen::VectorXd& b);

}  // namespace airybench
