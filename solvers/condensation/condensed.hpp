// The condensed contact problem, the paper's eq. (5): contact displacements from contact forces.
//
//   ū_C = D F_C − G      D  n_c × n_c, mm/N, symmetric positive definite compliance of the body
//                        G  n_c, mm; −G are the displacements with no contact force
//
// Rows in the order of ContactPoints: per point normal, tangential (μ = 0: normal only).
#pragma once

#include <Eigen/Cholesky>
#include <string>

namespace airybench {

struct CondensedSystem {
  Eigen::MatrixXd D;
  Eigen::VectorXd G;
  std::size_t bytes() const {
    return static_cast<std::size_t>(D.size() + G.size()) * sizeof(double);
  }
};

// Of a dense block. Throws Breakdown naming it when it is not positive definite to rounding.
Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix, const std::string& name);

}  // namespace airybench
