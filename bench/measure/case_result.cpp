#include "bench/measure/case_result.hpp"

#include <fmt/format.h>

#include <cmath>

namespace airybench {
namespace {

void write(const Search& search, Record& record) {
  take_over(search, record);
  for (const Search::Attempt& attempt : search.attempts) {
    Json json = {{"tolerance", attempt.tolerance},
                 {"claimed_status", name_of(attempt.claimed_status)}};
    if (attempt.error_estimate) json["error_estimate"] = *attempt.error_estimate;
    if (attempt.error) json["error"] = *attempt.error;
    record.attempts.push_back(std::move(json));
  }
}

void write(const Solution& solution, bool with_histories, Record& record) {
  take_over(solution, record);
  record.claimed_status = solution.status;
  if (const std::size_t bytes = matrix_bytes(solution); bytes > 0)
    record.storage_bytes = static_cast<std::int64_t>(bytes);
  if (solution.factor_flops) record.factor_flops = std::llround(*solution.factor_flops);
  if (const auto& times = solution.iteration_times) {
    record.iteration_matrix_s = times->matrix_s;
    record.iteration_smoother_s = times->smoother_s;
    record.iteration_coarse_s = times->coarse_s;
  }
  if (!with_histories) return;
  for (const IterationHistory& history : solution.histories)
    record.histories[history.what] = history.residual;
}

void write(const std::optional<Bracket>& bracket, std::optional<double>& low,
           std::optional<double>& high) {
  if (!bracket) return;
  low = bracket->low;
  high = bracket->high;
}

void write(const ContactIntervals& intervals, Record& record) {
  record.intervals = intervals.guaranteed ? "guaranteed" : "estimated";
  write(intervals.normal_resultant_N, record.normal_resultant_low_N,
        record.normal_resultant_high_N);
  write(intervals.tangential_resultant_N, record.tangential_resultant_low_N,
        record.tangential_resultant_high_N);
  record.largest_pressure_MPa = intervals.largest_pressure_MPa;
  record.largest_pressure_is = name_of(intervals.peak);
  write(intervals.largest_pressure_within_MPa, record.largest_pressure_low_MPa,
        record.largest_pressure_high_MPa);
  record.contact_ends = Json::array();
  for (const ContactEnd& end : intervals.ends)
    record.contact_ends.push_back({{"face", end.face},
                                   {"from", name_of(end.before)},
                                   {"to", name_of(end.after)},
                                   {"x_mm", end.at_mm.x()},
                                   {"y_mm", end.at_mm.y()},
                                   {"low_mm", end.along_face_mm.low},
                                   {"high_mm", end.along_face_mm.high}});
}

void write(const DiscretisationError& error, Record& record) {
  const TotalError& total = error.total;
  record.error_total = total.relative();
  record.error_discretisation = total.of_mesh();
  record.no_discretisation_error = total.flaw().empty() ? error.missing : total.flaw();
  if (total.of_mesh()) record.discretisation_by = error.by;
  if (total.geometry() > 0) record.error_geometry = total.geometry();
  if (total.sliding().mm > 0) {
    record.slide_mm = total.sliding().mm;
    record.slide_turn = total.sliding().turn;
  }
  if (error.relative_of_mean)
    record.error_mean = *error.relative_of_mean + record.error_stress.value_or(0) / 2;
  if (!error.of_steps.empty()) {
    record.lower_bound_Nmm = error.of_steps.back().lower_bound_Nmm;
    record.upper_bound_Nmm = error.of_steps.back().upper_bound_Nmm;
  }
  if (error.intervals) write(*error.intervals, record);
  for (std::size_t k = 0; k < std::min(record.steps.size(), error.of_steps.size()); ++k)
    record.steps[k].of_mesh = error.of_steps[k];
}

void write(const Memory& memory, Record& record) {
  take_over(memory, record);
  if (!memory.split) return;
  take_over(*memory.split, record);
  record.memory_by_owner = by_owner(*memory.split);
  record.memory_counts_differ = counts_differ(*memory.split);
}

}  // namespace

Json to_json(const TimedRun& run) {
  return {{"time_s", run.time_s},
          {"stages", run.stages},
          {"status", name_of(run.end.status)},
          {"message", run.end.reason},
          {"runs_s", run.runs_s},
          {"program_s", run.program_s},
          {"processor_s", run.processor_s},
          {"program_solve_s", run.program_solve_s}};
}

TimedRun timed_run_of(const Json& json) {
  return {json.at("time_s").get<double>(),
          json.at("stages").get<std::map<std::string, double>>(),
          {status_of(json.at("status").get<std::string>()).value_or(Status::crashed),
           json.at("message").get<std::string>()},
          json.at("runs_s").get<double>(),
          json.at("program_s").get<double>(),
          json.at("processor_s").get<double>(),
          json.at("program_solve_s").get<double>()};
}

Record to_record(const Case& asked, const Limits& limits, const CaseResult& result) {
  Record record = blank_record(asked, limits);
  take_over(result, record);
  write(result.search, record);
  if (result.solution) write(*result.solution, asked.settings.histories, record);
  if (record.load_steps > 1) record.steps = step_results(result.steps);
  if (result.verification) {
    take_over(*result.verification, record);
    record.answer_hash = answer_hash(*result.verification);
  }
  if (result.is_other_solution) record.outcome = other_solution;
  if (result.is_right_on_the_mesh) record.outcome = name_of(Status::inaccurate);
  write(result.of_mesh, record);
  write(result.memory, record);
  record.conclude(result.verdict);
  record.measured_once = result.only_run.has_value();
  if (result.only_run) add_run(*result.only_run, record);
  return record;
}

bool is_measured(const Case& asked, const CaseResult& result) {
  return is_measured(result.verdict.status, name_of(asked.points), result.verification.has_value());
}

Verdict ended_otherwise(const TimedRun& run, const char* which) {
  return {run.end.status, fmt::format("in a {} run: {}", which, run.end.reason)};
}

void add_run(const TimedRun& run, Record& record) {
  if (run.runs_s > 0) record.runs_s = run.runs_s;
  if (run.end.status != record.claimed_status) {
    record.conclude(ended_otherwise(run, "timed"));
    for (const char* name :
         {"samples_s", "stage_samples", "program_samples_s", "processor_samples_s",
          "program_solve_samples_s", "peak_heap_bytes", "peak_rss_bytes", "memory_by_owner",
          "memory_counts_differ", "heap_allocations", "heap_allocated_bytes"})
      field_named(name).clear(record);
    return;
  }
  record.samples_s.push_back(run.time_s);
  record.stage_samples.push_back(run.stages);
  if (run.program_s > 0) {
    record.program_samples_s.push_back(run.program_s);
    record.processor_samples_s.push_back(run.processor_s);
    record.program_solve_samples_s.push_back(run.program_solve_s);
  }
}

}  // namespace airybench
