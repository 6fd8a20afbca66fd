#include "solvers/contact/condensed.hpp"

#include <sstream>

#include "solvers/contact/active_set.hpp"

namespace airybench {

void solve_condensed_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                             const RunControl& control, Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  if (contact.size() == 0) return;
  const StageTimer timer(solution.times, Stage::contact);
  const OwnerScope scope(MemoryOwner::condensed);
  ContactResult result = solve_contact_by_gauss_seidel(condensed, contact, control);
  if (!result.converged && control.active_sets)
    finish_by_active_set(condensed, contact, control, result);
  solution.F_C = std::move(result.F_C);
  solution.contact_iterations = result.sweeps;
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
