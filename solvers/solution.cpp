#include "solvers/solution.hpp"

namespace airybench {

std::size_t matrix_bytes(const Solution& solution) {
  return solution.storage.sum() - solution.storage[MemoryOwner::iteration] + solution.file_bytes;
}

}  // namespace airybench
