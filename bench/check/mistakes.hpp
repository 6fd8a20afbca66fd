// Mistakes that a program can make with a contact problem, and the contact forces that each leads
// to: those of the problem as the program reads it, in the order and unit in which it writes them.
#pragma once

#include <string>
#include <vector>

#include "assembly/contact_problem.hpp"

namespace airybench {

struct Mistake {
  std::string name;     // "the sign of G"
  Eigen::VectorXd F_C;  // N; empty: it has no answer
};

// All mistakes, in the same order for every problem; variants of one have its name. right: the
// problem's answer.
std::vector<Mistake> mistakes_with(const contact::Problem& problem, const Eigen::VectorXd& right);

// ‖a − b‖ ≤ 1e-4 ‖b‖. Programs that make the same mistake agree to their own accuracy.
bool are_alike(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace airybench
