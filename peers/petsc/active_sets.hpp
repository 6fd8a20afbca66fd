// The contact law by active sets on K (solvers/two_level/active_rows.hpp), and how wrong the answer
// is (solvers/two_level/rows_check.hpp), over the ranks.
//
// Points that the body would pass through the wall begin as closed and sticking, the others as
// open. A linear system is solved until its error is a tenth of the natural map. Laws and forces of
// Γ_C are known to every rank.
#pragma once

#include <map>

#include "peers/petsc/linear_solver.hpp"

namespace airybench {

struct ContactAnswer {
  parallel::OwnedVec u;  // slots; zero where prescribed
  Eigen::VectorXd F_C, u_C;
  std::vector<PointLaw> laws;
  bool converged = false;
  double natural_map = 0;   // relative
  double linear_error = 0;  // relative, in the energy norm
  int steps = 0, iterations = 0, most_in_a_step = 0;
};
// scale: energy norm of the loads, for a body without stress.
ContactAnswer solve_contact(EdgeSystem& system, LinearSolver& solver, double scale,
                            double tolerance);

// The largest relative error that the answer's stresses and F_C have; adds its iterations.
double estimate_error(EdgeSystem& system, LinearSolver& solver, double scale,
                      ContactAnswer& answer);

}  // namespace airybench
