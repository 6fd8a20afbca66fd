#include "solvers/solution.hpp"

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

}  // namespace airybench
