#include "solvers/base/solution.hpp"

#include <cmath>
#include <sstream>

namespace airybench {

std::size_t matrix_bytes(const Solution& solution) {
  return solution.storage.sum() - solution.storage[MemoryOwner::iteration] + solution.file_bytes;
}

void stop_unconverged(const std::string& iteration, bool is_finite, const std::string& message,
                      Solution& solution) {
  solution.status = is_finite ? Status::not_converged : Status::breakdown;
  solution.message =
      iteration + ": " + (is_finite ? message : "its iterates are no longer finite numbers");
}

void judge_by_own_estimate(double estimate, const RunControl& control, Solution& solution) {
  solution.error_estimate = estimate;
  if (solution.status != Status::ok || estimate <= control.target_error) return;
  if (std::isnan(estimate)) {
    solution.status = Status::breakdown;
    solution.message = "its own estimate of its error is not finite";
    return;
  }
  std::ostringstream message;
  message << "by its own estimate its error is " << estimate << " (target " << control.target_error
          << ")";
  solution.status = Status::inaccurate;
  solution.message = message.str();
}

}  // namespace airybench
