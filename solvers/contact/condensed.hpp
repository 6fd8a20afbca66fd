// The condensed contact problem, the paper's eq. (5): contact displacements from contact forces.
//
//   ū_C = D F_C − G      D  n_c × n_c, mm/N, symmetric positive definite compliance of the body
//                        G  n_c, mm; −G are the displacements with no contact force
//
// Rows in the order of ContactPoints: per point normal, tangential (μ = 0: normal only).
#pragma once

#include "assembly/dual_system.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

struct CondensedSystem {
  Eigen::MatrixXd D;
  Eigen::VectorXd G;
  std::size_t bytes() const {
    return static_cast<std::size_t>(D.size() + G.size()) * sizeof(double);
  }
};

// ‖F‖_D = √(Fᵀ D F), √(N mm): the energy norm of the stresses that contact forces alone make.
double D_norm(const Eigen::MatrixXd& D, const Eigen::VectorXd& F);

// The contact law of a condensed system into the solution: its forces, status, counts and history.
// Without contact points there is nothing to do and the status is ok.
//
// By control.contact; with the paper's stop by Gauss–Seidel.
void solve_condensed_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                             const RunControl& control, Solution& solution);

}  // namespace airybench
