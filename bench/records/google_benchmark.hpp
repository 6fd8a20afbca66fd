// Records in the JSON of Google Benchmark, for compare.py and other readers of it. Its own reporter
// writes the runs, so the schema is the library's.
#pragma once

#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// A case is the benchmark MESH/SCENE/METHOD/iterations:1/manual_time: a run per sample, real_time
// in ms, then mean, median, stddev and cv of two samples or more; cpu_time is 0. Counters: the
// numeric columns but those of the schema. A case without samples is one run with error_occurred
// and "status: reason". `context` is that of the first case, not of the machine that exports.
// Throws std::runtime_error when the library wrote what is not JSON.
std::string google_benchmark_json(const std::vector<Record>& cases);

}  // namespace airybench
