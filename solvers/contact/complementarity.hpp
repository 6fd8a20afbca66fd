// Small linear complementarity problems, by Lemke's pivots (Cottle, Pang & Stone 1992,
// section 4.4):
//
//   w = A z + b ≥ 0,   z ≥ 0,   zᵀ w = 0
//
// They end with a solution where A is copositive and z·b ≥ 0 for all z ≥ 0 with A z ≥ 0, z·A z = 0:
// such are those of rigid bodies with Coulomb's law. Ties are decided lexicographically.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace airybench {

// Column k of b is ε^k of it, ε → 0; likewise of z. Columns should have the size 1. None: no
// solution was found.
std::optional<Eigen::MatrixXd> solve_complementarity(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& b);

}  // namespace airybench
