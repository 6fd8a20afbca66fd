#include "bench/records/record.hpp"

#include <algorithm>
#include <cmath>

#include "bench/records/json.hpp"
#include "bench/statistics/robust.hpp"

#include "bench/statistics/bootstrap.hpp"

namespace airybench {
namespace {

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// Median over the runs that have the stage.
Json stage_median(const Record& record, Stage stage) {
  std::vector<double> values;
  for (const StageTimes& times : record.stage_samples)
    if (times[stage]) values.push_back(*times[stage]);
  return number_or_null(median(std::move(values)));
}

template <typename T>
Json verified(const Record& record, std::optional<T> Verification::*value) {
  return record.verification ? or_null(*record.verification.*value) : Json();
}
Json verified(const Record& record, double Verification::*value) {
  return record.verification ? number_or_null(*record.verification.*value) : Json();
}

// Algebraic and discretisation error together, relative, in the energy norm. A displacement method
// has no algebraic error against the reference.
Json total_error(const Record& record) {
  if (!record.error_discretisation || !record.verification) return {};
  return number_or_null(*record.error_discretisation +
                        record.verification->error_stress.value_or(0));
}

}  // namespace

void add_run(const TimedRun& run, Record& record) {
  if (run.runs_s > 0) record.runs_s = run.runs_s;
  if (run.status == record.claimed_status) {
    record.samples_s.push_back(run.time_s);
    record.stage_samples.push_back(run.stages);
    return;
  }
  record.status = run.status;
  record.status_reason = "in a timed run: ";
  record.status_reason += run.message;
  record.signal = run.signal;
  record.ended_in = run.ended_in;
  if (!run.ended_in.empty()) record.time_so_far_s = run.time_s;
  record.samples_s.clear();
  record.stage_samples.clear();
  record.peak_heap_bytes.reset();
  record.memory.reset();
  record.peak_rss_bytes.reset();
}

CaseName name_of(const Record& r) {
  return {r.mesh, r.scene, r.method, r.study, r.knob, r.knob_value, r.stop};
}

bool is_measured(const Record& record) {
  return record.status == Status::ok || record.status == Status::inaccurate ||
         (record.study == "error" && record.status == Status::not_converged && record.verification);
}

std::string outcome_of(const Record& record) {
  if (record.status == Status::inaccurate && record.claimed_status == Status::ok)
    return record.verification && record.verification->error_stress ? "wrong_success"
                                                                    : "unverified";
  return std::string(name_of(record.status));
}

std::string column_of(Stage stage) { return "stage_" + std::string(name_of(stage)) + "_s"; }

GridSummary summary_of(const std::vector<GridPoint>& grid) {
  if (grid.empty()) return {};
  std::vector<double> iterations;
  GridSummary summary;
  summary.failures = 0;
  for (const GridPoint& point : grid) {
    if (point.outcome == "diverged")
      ++*summary.failures;
    else if (point.iterations > 0)
      iterations.push_back(point.iterations);
    if (point.outcome == "converged")
      summary.best = std::min(summary.best.value_or(point.iterations), point.iterations);
  }
  if (iterations.empty()) return summary;
  summary.median = static_cast<int>(median(iterations));
  summary.worst = static_cast<int>(*std::max_element(iterations.begin(), iterations.end()));
  return summary;
}

Columns columns(const Record& r) {
  const Interval interval = r.samples_s.size() > 1 ? bootstrap_median(r.samples_s) : Interval{};
  const auto smallest = std::min_element(r.samples_s.begin(), r.samples_s.end());
  Columns result = {
      {"mesh", r.mesh},
      {"scene", r.scene},
      {"method", r.method},
      {"status", std::string(name_of(r.status))},
      {"status_reason", r.status_reason.empty() ? Json() : Json(r.status_reason)},
      {"n_phi", r.n_phi},
      {"n_f", r.n_f},
      {"n_c", r.n_c},
      {"threads", r.threads},
      {"repetitions", r.samples_s.size()},
      {"time_s", number_or_null(median(r.samples_s))},
      {"time_min_s", smallest == r.samples_s.end() ? Json() : Json(*smallest)},
      {"time_mad_s", number_or_null(median_absolute_deviation(r.samples_s))},
      {"time_low_s", interval.low > 0 ? Json(interval.low) : Json()},
      {"time_high_s", interval.low > 0 ? Json(interval.high) : Json()},
      {"assembly_s", number_or_null(median(r.assembly_samples_s))},
  };
  for (const Stage stage : all_stages)
    result.emplace_back(column_of(stage), stage_median(r, stage));
  const GridSummary grid = summary_of(r.grid);
  const Columns measures = {
      {"peak_heap_bytes", or_null(r.peak_heap_bytes)},
      {"peak_rss_bytes", or_null(r.peak_rss_bytes)},
      {"storage_bytes", r.storage_bytes > 0 ? Json(r.storage_bytes) : Json()},
      {"linear_iterations", or_null(r.linear_iterations)},
      {"contact_iterations", or_null(r.contact_iterations)},
      {"uzawa_iterations", or_null(r.uzawa_iterations)},
      {"stop", r.stop == Stop::paper ? "paper" : "target"},
      {"target_error", r.target_error},
      {"tolerance", or_null(r.tolerance)},
      {"parameters", r.parameters.empty() ? Json() : Json(r.parameters)},
      {"tuning_s", or_null(r.tuning_s)},
      {"grid_best", or_null(grid.best)},
      {"grid_median", or_null(grid.median)},
      {"grid_worst", or_null(grid.worst)},
      {"grid_failures", or_null(grid.failures)},
      {"done_fraction", or_null(r.done_fraction)},
      {"extrapolated_time_s", or_null(r.extrapolated_time_s)},
      {"error_so_far", or_null(r.error_so_far)},
      {"error_stress", verified(r, &Verification::error_stress)},
      {"error_force", verified(r, &Verification::error_force)},
      {"equilibrium_residual", verified(r, &Verification::equilibrium_residual)},
      {"natural_map_residual", verified(r, &Verification::natural_map_residual)},
      {"signorini_violation_N", verified(r, &Verification::signorini_violation_N)},
      {"coulomb_violation_N", verified(r, &Verification::coulomb_violation_N)},
      {"normal_resultant_N", verified(r, &Verification::normal_resultant_N)},
      {"tangential_resultant_N", verified(r, &Verification::tangential_resultant_N)},
      {"strain_energy_Nmm", verified(r, &Verification::strain_energy_Nmm)},
      {"complementary_energy_Nmm", verified(r, &Verification::complementary_energy_Nmm)},
      {"n_open", verified(r, &Verification::n_open)},
      {"n_stick", verified(r, &Verification::n_stick)},
      {"n_slip", verified(r, &Verification::n_slip)},
      {"outcome", outcome_of(r)},
      {"claimed_status", r.claimed_status ? Json(std::string(name_of(*r.claimed_status))) : Json()},
      {"error_estimate", or_null(r.error_estimate)},
      {"condition_estimate", or_null(r.condition_estimate)},
      {"error_discretisation", or_null(r.error_discretisation)},
      {"error_total", total_error(r)},
      {"lower_bound_Nmm", or_null(r.lower_bound_Nmm)},
      {"upper_bound_Nmm", or_null(r.upper_bound_Nmm)},
      {"study", r.study.empty() ? Json() : Json(r.study)},
      {"knob", r.knob.empty() ? Json() : Json(r.knob)},
      {"knob_value", or_null(r.knob_value)},
      {"scene_group", r.scene_group.empty() ? Json() : Json(r.scene_group)},
      {"signal", r.signal.empty() ? Json() : Json(r.signal)},
      {"ended_in", r.ended_in.empty() ? Json() : Json(r.ended_in)},
      {"time_so_far_s", or_null(r.time_so_far_s)},
      {"instructions", or_null(r.instructions)},
      {"answer_hash", r.answer_hash.empty() ? Json() : Json(r.answer_hash)},
      {"runs_s", or_null(r.runs_s)},
      {"wall_s", or_null(r.wall_s)},
      {"noise_kernel_s", number_or_null(median(r.noise_kernel_samples_s))},
      {"factor_entries", or_null(r.factor_entries)},
      {"factor_flops", or_null(r.factor_flops)},
      {"library_bytes", or_null(r.library_bytes)},
      {"memory_count_ratio", r.memory ? or_null(count_ratio(*r.memory)) : Json()},
      {"heap_allocations", r.memory ? Json(r.memory->allocations) : Json()},
      {"heap_allocated_bytes", r.memory ? Json(r.memory->allocated_bytes) : Json()},
  };
  result.insert(result.end(), measures.begin(), measures.end());
  return result;
}

Json json_of(const StageTimes& times) {
  Json json = Json::object();
  for (const Stage stage : all_stages)
    if (times[stage]) json[std::string(name_of(stage))] = *times[stage];
  return json;
}

Json to_json(const Record& r) {
  Json json;
  for (const auto& [name, value] : columns(r)) json[name] = value;
  json["samples_s"] = r.samples_s;
  Json stage_samples = Json::array();
  for (const StageTimes& times : r.stage_samples) stage_samples.push_back(json_of(times));
  json["stage_samples"] = stage_samples;
  json["assembly_samples_s"] = r.assembly_samples_s;
  json["noise_kernel_samples_s"] = r.noise_kernel_samples_s;
  json["case_number"] = r.case_number;
  json["measured_once"] = r.measured_once;
  json["mesh_file"] = r.mesh_file;
  json["mesh_sha256"] = r.mesh_sha256;
  json["scene_definition"] = parse_json(r.scene_definition);
  json["blocks_heap_bytes"] = or_null(r.blocks_heap_bytes);
  json["assembly_peak_heap_bytes"] = or_null(r.assembly_peak_heap_bytes);
  json["process_peak_heap_bytes"] = or_null(r.process_peak_heap_bytes);
  json["memory_by_owner"] = r.memory ? by_owner(*r.memory) : Json();
  json["memory_by_stage"] = r.memory ? by_stage(*r.memory) : Json();
  json["memory_counts_differ"] = r.memory ? Json(counts_differ(*r.memory)) : Json();
  Json run = Json::array(), left_out = Json::object();
  for (const StageDecision& decision : r.stages) {
    if (decision.run)
      run.push_back(decision.stage);
    else
      left_out[decision.stage] = decision.reason;
  }
  json["stages_run"] = run;
  json["stages_left_out"] = left_out;
  if (!r.grid.empty()) {
    Json grid = Json::array();
    for (const GridPoint& point : r.grid)
      grid.push_back({{"r", point.r},
                      {"rho", point.rho},
                      {"iterations", point.iterations},
                      {"outcome", point.outcome}});
    json["grid"] = grid;
  }
  if (!r.histories.empty()) {
    Json histories = Json::object();
    for (const IterationHistory& history : r.histories) histories[history.what] = history.residual;
    json["histories"] = histories;
  }
  return json;
}

}  // namespace airybench
