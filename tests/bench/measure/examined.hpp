// A case's detail run, by a workbench that assembles once.
#pragma once

#include "bench/measure/workbench.hpp"
#include "tests/support/posed.hpp"

namespace airybench::testing {

inline Record examined(std::shared_ptr<const Problem> problem, const Method& method,
                       Options options = {}) {
  options.repetitions = 1;
  Workbench bench(std::move(problem), options);
  return bench.examine(method, {}).record;
}
inline Record examined(std::shared_ptr<const Problem> problem, const char* method,
                       const Options& options = {}) {
  return examined(std::move(problem), select_methods(method).front(), options);
}

// The same with its memory run and one timed run.
inline Record measured(std::shared_ptr<const Problem> problem, const Method& method) {
  Options options;
  options.repetitions = 1;
  Workbench bench(std::move(problem), options);
  auto [record, choice, log] = bench.examine(method, {});
  if (!is_measured(record)) return record;
  bench.measure_memory(method, choice, record);
  add_run(bench.measure_time(method, choice), record);
  return record;
}

}  // namespace airybench::testing
