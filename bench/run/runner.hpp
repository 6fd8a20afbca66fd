// Runs cases. A case's way from the command to its record:
//
//   run_command()    bench/commands: plans the cases and passes them to
//   run_cases()      skips cases that have a record; passes each scene's cases to
//   Google Benchmark one benchmark per case, manual time, one iteration per repetition; calls
//   SceneRunner      (runner.cpp) decides how often to time a case, and repeats noisy ones; asks
//   IsolatedScene    (isolated_scene.hpp) for an examination and for times, which come from
//   Workbench        bench/measure, in the case's process: solves, verifies and measures.
//   Record           returns as JSON; SceneRunner adds the samples and appends it to
//   RecordFiles      bench/records: a line on disk
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/context.hpp"
#include "bench/records/record.hpp"
#include "bench/records/record_files.hpp"
#include "bench/report/prediction.hpp"
#include "bench/run/noise_watch.hpp"

namespace airybench {

struct RunTimes {
  double wall_s = 0;
  double runs_s = 0;         // in solves, tuning included
  double preparation_s = 0;  // assembly and references
  double judging_s = 0;      // verification, and the rest between a case's solves
  double harness_s() const { return wall_s - runs_s - preparation_s - judging_s; }
};

struct RunResult {
  std::unique_ptr<const RecordFiles> files;
  std::vector<std::string> names;  // of the planned cases that have a record, in plan order
  int earlier = 0;                 // records that --resume found
  RunTimes times;

  Record record(std::size_t k) const { return files->read(names[k]); }
  std::vector<Record> records() const;  // all of them in memory
};

// Prints progress to standard error. Throws FileError, Interrupted; the records so far are on disk.
RunResult run_cases(const std::vector<Case>& plan, const Limits& limits, const Output& output,
                    const Context& context, const Machine& machine = this_machine());

// Google Benchmark reads its options from these variables before main(): starts the program again
// without them. Throws std::system_error.
void restart_without_benchmark_variables(char* const* argv);

// The cases whose names match, as Google Benchmark's filter does, which would come too late for
// plans and forecasts, and would see the names that it makes of these: an unanchored extended
// regular expression; a leading '-' inverts it. Throws UsageError if the expression is invalid.
std::vector<Case> matching(std::vector<Case> plan, const std::string& filter);

int min_repetitions(const Limits& limits);
int max_repetitions(const Limits& limits);
// For the forecast of the cases.
RunLimits limits_of(const Limits& limits, const std::vector<Case>& plan);
// False after the most repetitions or long_case_s, and after the least if the precision is reached.
bool is_repeated(const Record& record, const Limits& limits);

}  // namespace airybench
