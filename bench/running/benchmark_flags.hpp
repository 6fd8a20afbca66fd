// What Google Benchmark is told, and what it says of names.
#pragma once

#include <string>
#include <vector>

#include "bench/cases/plan.hpp"

namespace airybench {

enum class Benchmarks { run, list };

// All that its environment variables could change (BENCHMARK_FILTER and so on) is set: a run is
// what its own options say.
void set_benchmark_flags(Benchmarks mode, bool interleave);

// The cases whose names its --benchmark_filter selects: a regular expression that matches
// somewhere, with a leading '-' the others. Throws UsageError: no expression, or it matches no
// case.
std::vector<Case> matching(const std::vector<Case>& plan, const std::string& filter);

}  // namespace airybench
