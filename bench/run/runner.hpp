// Runs cases. The way of one case, from the command to its record:
//
//   run_command()    bench/commands: plans the cases, hands all of them to
//   run_cases()      which leaves out those that have a record already, and hands each scene's to
//   Google Benchmark one benchmark a case, manual time, one iteration per repetition; it calls
//   SceneRunner      (runner.cpp) which decides how often a case is timed, and whether again
//                    because it was noisy (noise_watch.hpp); it asks
//   IsolatedScene    (isolated_scene.hpp) for an examination and for times, which come from
//   Workbench        bench/measure, in the case's process: it solves, verifies and measures.
//   Record           JSON on the way back; SceneRunner adds the samples and appends it to
//   RecordFiles      bench/records: a line on disk
#pragma once

#include <string>
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

// The cases whose names Google Benchmark's filter selects: a regular expression that matches
// somewhere, with a leading '-' the others. Throws UsageError: no such expression.
std::vector<Case> matching(std::vector<Case> plan, const std::string& filter, bool interleave);

// How often a case is timed that is repeated at all, whatever the samples are.
int least_repetitions(const Options& options);
int most_repetitions(const Options& options);
// Is a case with these samples timed once more? Up to the least repetitions, then as long as the
// precision is not reached; not when the samples add up to long_case_s, nor after the most.
bool is_repeated(const Record& record, const Options& options);

}  // namespace airybench
