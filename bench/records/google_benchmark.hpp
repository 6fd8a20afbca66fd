// Exports records in Google Benchmark's JSON; the library's reporter writes the runs.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

// A case is the benchmark MESH/SCENE/METHOD/iterations:1/manual_time. It has a run per sample, with
// real_time in ms and cpu_time 0; from two samples on also mean, median, stddev and cv. Counters
// are numeric fields outside the schema. A case without samples is one run with error_occurred and
// "status: reason". Both functions return the text to add, and throw std::runtime_error if the
// library writes invalid JSON.
class GoogleBenchmarkJson {
 public:
  GoogleBenchmarkJson() { reporter_.SetOutputStream(&text_); }
  std::string add(const Record& record);
  std::string end();

 private:
  std::ostringstream text_;
  benchmark::JSONReporter reporter_;
  std::size_t cases_ = 0;
};

std::string google_benchmark_json(const std::vector<Record>& cases);

}  // namespace airybench
