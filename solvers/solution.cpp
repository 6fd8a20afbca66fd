#include "solvers/solution.hpp"

#include <sstream>

namespace airybench {

std::string_view name_of(Status status) {
  constexpr std::array<std::string_view, 8> names = {"ok",        "inaccurate", "not_converged",
                                                     "breakdown", "timeout",    "out_of_memory",
                                                     "crashed",   "skipped"};
  return names[static_cast<std::size_t>(status)];
}

std::size_t matrix_bytes(const Solution& solution) {
  return solution.storage.sum() - solution.storage[MemoryOwner::iteration] + solution.file_bytes;
}

void judge_by_own_estimate(double estimate, const RunControl& control, Solution& solution) {
  solution.error_estimate = estimate;
  if (solution.status != Status::ok || estimate <= control.target_error) return;
  std::ostringstream message;
  message << "by its own estimate its error is " << estimate << " (target " << control.target_error
          << ")";
  solution.status = Status::inaccurate;
  solution.message = message.str();
}

}  // namespace airybench
