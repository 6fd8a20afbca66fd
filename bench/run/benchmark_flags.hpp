// What Google Benchmark is told, and which cases it selects.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/plan.hpp"

namespace airybench {

// With flags for all that its environment variables could change (BENCHMARK_FILTER and so on): a
// run is what its own options say.
void initialize_benchmark(bool interleave);

// The cases whose names its --benchmark_filter selects: a regular expression that matches
// somewhere, with a leading '-' the others. Throws UsageError: no such expression.
std::vector<Case> matching(std::vector<Case> plan, const std::string& filter, bool interleave);

}  // namespace airybench
