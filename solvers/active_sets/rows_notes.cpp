#include "solvers/active_sets/rows_notes.hpp"

#include <cmath>
#include <sstream>

namespace airybench {

void note_rows(const RowsResult& rows, const ContactPoints& contact, const RunControl& control,
               double tolerance, Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  solution.linear_iterations = rows.iterations;
  if (contact.count > 0) {
    solution.contact_iterations = rows.sweeps;
    solution.newton_steps = rows.steps;
  }
  if (control.histories)
    solution.histories.push_back({"relative error of the linear system per step", rows.history});
  if (rows.converged) return;
  std::ostringstream message;
  message << "natural map residual " << rows.natural_map_residual << ", linear error "
          << rows.linear_error << " after " << rows.steps << " active sets and " << rows.iterations
          << " linear iterations (tolerance " << tolerance << ")";
  stop_unconverged("active sets on the hybridized matrix",
                   !std::isnan(rows.natural_map_residual + rows.linear_error), message.str(),
                   solution);
}

}  // namespace airybench
