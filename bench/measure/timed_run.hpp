// One timed run of a case, as it travels from the case's process.
#pragma once

#include <map>
#include <string>

#include "bench/records/record.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

struct TimedRun {
  double time_s = 0;
  std::map<std::string, double> stages;  // stage → seconds
  Status status = Status::crashed;
  std::string message = "the run did not take place";
  std::string signal, ended_in;  // see record_fields.def
  double runs_s = 0;             // of the case, up to here
  double program_s = 0;          // of another's program, from its start to its end
};

Json to_json(const TimedRun& run);
TimedRun timed_run_of(const Json& json);

// The stages that there are.
std::map<std::string, double> by_name(const StageTimes& times);

// Adds its sample. A run that ended otherwise than the detail run did sets the record's status, and
// takes the samples away.
void add_run(const TimedRun& run, Record& record);

}  // namespace airybench
