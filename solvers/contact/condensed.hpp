// The condensed contact problem (contact_problem.hpp) as the last stage of a method.
#pragma once

#include "assembly/contact_problem.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// ‖F‖_D = √(Fᵀ D F), √(N mm): the energy norm of the stresses that contact forces alone make.
double D_norm(const Eigen::MatrixXd& D, const Eigen::VectorXd& F);

// Solves the contact law by solve_contact() into the solution: forces, status, counts and history.
// Without contact points there is nothing to do and the status is ok.
void solve_condensed_contact(const contact::Problem& problem, const RunControl& control,
                             Solution& solution);

}  // namespace airybench
