// Runs cases through Google Benchmark: one registered benchmark a case, manual time, one iteration
// per repetition. Each case runs in a process of its own (isolated_scene.hpp).
#pragma once

#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/context.hpp"
#include "bench/records/record.hpp"
#include "bench/run/noise_watch.hpp"

namespace airybench {

// What a run spent outside the cases' own solves.
struct RunTimes {
  double wall_s = 0;
  double runs_s = 0;         // in solves, tuning included
  double preparation_s = 0;  // assembly and references
  double judging_s = 0;      // verification, and all else between a case's solves
  double harness_s() const { return wall_s - runs_s - preparation_s - judging_s; }
};

struct RunResult {
  std::vector<Record> records;  // of all cases of the plan, in its order; earlier ones included
  int earlier = 0;              // that --resume found
  bool torn = false;            // it found a line half written, too
  RunTimes times;
};

// Prints progress to standard error, writes the output folder. Throws FileError, Interrupted; what
// was measured is on disk then.
RunResult run_cases(const std::vector<Case>& plan, const Options& options, const Context& context,
                    const Machine& machine = this_machine());

}  // namespace airybench
