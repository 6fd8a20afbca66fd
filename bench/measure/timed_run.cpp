#include "bench/measure/timed_run.hpp"

namespace airybench {

Json to_json(const TimedRun& run) {
  return {{"time_s", run.time_s},   {"stages", run.stages},      {"status", name_of(run.status)},
          {"message", run.message}, {"signal", run.signal},      {"ended_in", run.ended_in},
          {"runs_s", run.runs_s},   {"program_s", run.program_s}};
}

TimedRun timed_run_of(const Json& json) {
  return {json.at("time_s").get<double>(),
          json.at("stages").get<std::map<std::string, double>>(),
          status_of(json.at("status").get<std::string>()).value_or(Status::crashed),
          json.at("message").get<std::string>(),
          json.at("signal").get<std::string>(),
          json.at("ended_in").get<std::string>(),
          json.at("runs_s").get<double>(),
          json.at("program_s").get<double>()};
}

std::map<std::string, double> by_name(const StageTimes& times) {
  std::map<std::string, double> seconds;
  for (const Stage stage : all_stages)
    if (times[stage]) seconds[std::string(name_of(stage))] = *times[stage];
  return seconds;
}

void add_run(const TimedRun& run, Record& record) {
  if (run.runs_s > 0) record.runs_s = run.runs_s;
  if (run.status == record.claimed_status) {
    record.samples_s.push_back(run.time_s);
    record.stage_samples.push_back(run.stages);
    if (run.program_s > 0) record.program_samples_s.push_back(run.program_s);
    return;
  }
  record.status = run.status;
  record.status_reason = "in a timed run: " + run.message;
  record.signal = run.signal;
  record.ended_in = run.ended_in;
  if (!run.ended_in.empty()) record.time_so_far_s = run.time_s;
  record.samples_s.clear();
  record.stage_samples.clear();
  record.program_samples_s.clear();
  for (const char* name :
       {"peak_heap_bytes", "peak_rss_bytes", "memory_by_owner", "memory_by_stage",
        "memory_counts_differ", "memory_count_ratio", "heap_allocations", "heap_allocated_bytes"})
    field_named(name).clear(record);
}

}  // namespace airybench
