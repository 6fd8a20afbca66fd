#include "solvers/contact/condensed.hpp"

#include <algorithm>
#include <sstream>

#include "solvers/contact/active_set.hpp"

namespace airybench {

ContactResult solve_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                            const RunControl& control) {
  if (!control.active_sets || control.stop == Stop::paper)
    return solve_contact_by_gauss_seidel(condensed, contact, control);
  constexpr int first_sweeps = 30;  // from fewer, active sets may cycle
  ContactResult best;
  ContactResult swept;
  RunControl part = control;
  int sweeps = 0, steps = 0;
  std::vector<double> history;
  for (int next = first_sweeps;; next *= 10) {
    part.contact_sweeps = std::min(next, control.contact_sweeps - sweeps);
    swept = solve_contact_by_gauss_seidel(condensed, contact, part, swept.F_C);
    sweeps += swept.sweeps;
    history.insert(history.end(), swept.history.begin(), swept.history.end());
    ContactResult result = swept;
    finish_by_active_set(condensed, contact, control, result);
    steps += result.active_set_steps;
    if (!(best.natural_map_residual <= result.natural_map_residual)) best = std::move(result);
    if (best.converged || sweeps >= control.contact_sweeps || !swept.F_C.allFinite()) break;
  }
  best.sweeps = sweeps;
  best.active_set_steps = steps;
  best.history = std::move(history);
  return best;
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
