#include "solvers/contact/condensed.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "solvers/contact/active_set.hpp"

namespace airybench {

double D_norm(const Eigen::MatrixXd& D, const Eigen::VectorXd& F) {
  return std::sqrt(std::max(0.0, F.dot(D * F)));
}

void solve_condensed_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                             const RunControl& control, Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  if (contact.size() == 0) return;
  const StageTimer timer(solution.times, Stage::contact);
  const OwnerScope scope(MemoryOwner::condensed);
  ContactResult result = solve_contact(condensed, contact, control);
  solution.F_C = std::move(result.F_C);
  solution.contact_iterations = result.sweeps;
  solution.newton_steps = result.active_set_steps;
  if (control.histories) {
    IterationHistory& history = solution.histories.emplace_back();
    history.what = "relative change of F_C per Gauss-Seidel sweep";
    history.residual = std::move(result.history);
  }
  if (!result.converged) {
    std::ostringstream message;
    message << "contact law: natural map residual " << result.natural_map_residual << " after "
            << result.sweeps << " Gauss-Seidel sweeps and " << result.active_set_steps
            << " active sets (tolerance " << control.contact_tolerance << ")";
    solution.status = Status::not_converged;
    solution.message = message.str();
  }
}

}  // namespace airybench
