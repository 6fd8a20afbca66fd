// D of the contact law in any of its forms (contact_problem.hpp).
#pragma once

#include "assembly/contact_problem.hpp"

namespace airybench {

Eigen::VectorXd D_times(const contact::Problem& problem, const Eigen::VectorXd& F);
Eigen::VectorXd D_diagonal(const contact::Problem& problem);  // of bodies rough
// m × m, of point p. Not of bodies.
Eigen::MatrixXd D_of_point(const contact::Problem& problem, int p);

// Throws Breakdown unless D is formed.
void need_formed(const contact::Problem& problem, const char* who);

}  // namespace airybench
