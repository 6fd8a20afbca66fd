// What a factor holds and what it took to make it, into the solution of the method that uses it.
#pragma once

#include "solvers/base/solution.hpp"

namespace airybench {

// Of a library's factor as it stands: workspace that solves leave counts afterwards.
template <typename Factor>
void count_factor(const Factor& factor, Solution& solution) {
  solution.storage[MemoryOwner::factor] = factor.bytes();
  solution.factor_entries = factor.entries();
  solution.factor_flops = factor.flops();
}

}  // namespace airybench
