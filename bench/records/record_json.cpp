#include "bench/records/record_json.hpp"

#include <limits>

#include "bench/records/case_name.hpp"
#include "bench/records/json.hpp"

namespace airybench {
namespace {

bool has(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && !found->is_null();
}

template <typename T>
void read(const Json& json, const char* key, T& value) {
  if (has(json, key)) value = json[key].get<T>();
}
template <typename T>
void read(const Json& json, const char* key, std::optional<T>& value) {
  if (has(json, key)) value = json[key].get<T>();
}
// A number that is not finite is null.
void read_finite(const Json& json, const char* key, double& value, double otherwise) {
  value = has(json, key) ? json[key].get<double>() : otherwise;
}

// Numbers, those that are not finite being null.
std::vector<double> numbers_of(const Json& list) {
  std::vector<double> numbers;
  for (const Json& number : list)
    numbers.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : number.get<double>());
  return numbers;
}

Status status_of(const std::string& name) {
  for (int i = 0; i <= static_cast<int>(Status::skipped); ++i)
    if (name_of(static_cast<Status>(i)) == name) return static_cast<Status>(i);
  return Status::crashed;
}

StageTimes stage_times_of(const Json& json) {
  StageTimes times;
  for (const Stage stage : all_stages)
    read(json, std::string(name_of(stage)).c_str(), times[stage]);
  return times;
}

Verification verification_of(const Json& json) {
  Verification v;
  read(json, "error_stress", v.error_stress);
  read(json, "error_force", v.error_force);
  read_finite(json, "equilibrium_residual", v.equilibrium_residual,
              std::numeric_limits<double>::infinity());
  read(json, "natural_map_residual", v.natural_map_residual);
  read(json, "signorini_violation_N", v.signorini_violation_N);
  read(json, "coulomb_violation_N", v.coulomb_violation_N);
  read(json, "normal_resultant_N", v.normal_resultant_N);
  read(json, "tangential_resultant_N", v.tangential_resultant_N);
  read_finite(json, "strain_energy_Nmm", v.strain_energy_Nmm,
              std::numeric_limits<double>::quiet_NaN());
  read(json, "complementary_energy_Nmm", v.complementary_energy_Nmm);
  read(json, "n_open", v.n_open);
  read(json, "n_stick", v.n_stick);
  read(json, "n_slip", v.n_slip);
  return v;
}

void read_what_was_solved(const Json& json, Record& r) {
  read(json, "mesh", r.mesh);
  read(json, "mesh_file", r.mesh_file);
  read(json, "mesh_sha256", r.mesh_sha256);
  read(json, "scene", r.scene);
  read(json, "scene_group", r.scene_group);
  if (has(json, "scene_definition")) r.scene_definition = json_text(json["scene_definition"]);
  read(json, "method", r.method);
  read(json, "case_number", r.case_number);
  read(json, "n_phi", r.n_phi);
  read(json, "n_f", r.n_f);
  read(json, "n_c", r.n_c);
  read(json, "threads", r.threads);
  if (has(json, "stop")) r.stop = stop_of(json["stop"].get<std::string>());
  read(json, "target_error", r.target_error);
  read(json, "study", r.study);
  read(json, "knob", r.knob);
  read(json, "knob_value", r.knob_value);
}

void read_measures(const Json& json, Record& r) {
  read(json, "samples_s", r.samples_s);
  if (has(json, "stage_samples")) {
    for (const Json& times : json["stage_samples"])
      r.stage_samples.push_back(stage_times_of(times));
  } else {  // older records have the medians alone
    StageTimes medians;
    for (const Stage stage : all_stages) read(json, column_of(stage).c_str(), medians[stage]);
    r.stage_samples.push_back(medians);
  }
  read(json, "assembly_samples_s", r.assembly_samples_s);
  read(json, "noise_kernel_samples_s", r.noise_kernel_samples_s);
  read(json, "instructions", r.instructions);
  read(json, "runs_s", r.runs_s);
  read(json, "wall_s", r.wall_s);
  read(json, "measured_once", r.measured_once);
  read(json, "peak_heap_bytes", r.peak_heap_bytes);
  read(json, "peak_rss_bytes", r.peak_rss_bytes);
  read(json, "blocks_heap_bytes", r.blocks_heap_bytes);
  read(json, "assembly_peak_heap_bytes", r.assembly_peak_heap_bytes);
  read(json, "process_peak_heap_bytes", r.process_peak_heap_bytes);
  read(json, "storage_bytes", r.storage_bytes);
  read(json, "factor_entries", r.factor_entries);
  read(json, "factor_flops", r.factor_flops);
  read(json, "library_bytes", r.library_bytes);
  if (has(json, "memory_by_owner")) {
    r.memory = memory_split_from(json["memory_by_owner"], json["memory_by_stage"]);
    read(json, "heap_allocations", r.memory->allocations);
    read(json, "heap_allocated_bytes", r.memory->allocated_bytes);
  }
  read(json, "linear_iterations", r.linear_iterations);
  read(json, "contact_iterations", r.contact_iterations);
  read(json, "uzawa_iterations", r.uzawa_iterations);
}

void read_outcome(const Json& json, Record& r) {
  if (has(json, "status")) r.status = status_of(json["status"].get<std::string>());
  r.status_reason.clear();
  read(json, "status_reason", r.status_reason);
  read(json, "signal", r.signal);
  read(json, "ended_in", r.ended_in);
  read(json, "time_so_far_s", r.time_so_far_s);
  if (has(json, "claimed_status"))
    r.claimed_status = status_of(json["claimed_status"].get<std::string>());
  read(json, "answer_hash", r.answer_hash);
  read(json, "tolerance", r.tolerance);
  read(json, "parameters", r.parameters);
  read(json, "tuning_s", r.tuning_s);
  read(json, "done_fraction", r.done_fraction);
  read(json, "extrapolated_time_s", r.extrapolated_time_s);
  read(json, "error_so_far", r.error_so_far);
  read(json, "error_estimate", r.error_estimate);
  read(json, "condition_estimate", r.condition_estimate);
  read(json, "error_discretisation", r.error_discretisation);
  read(json, "lower_bound_Nmm", r.lower_bound_Nmm);
  read(json, "upper_bound_Nmm", r.upper_bound_Nmm);
  if (has(json, "strain_energy_Nmm") || has(json, "equilibrium_residual"))
    r.verification = verification_of(json);
}

void read_lists(const Json& json, Record& r) {
  if (has(json, "stages_run"))
    for (const Json& stage : json["stages_run"])
      r.stages.push_back({stage.get<std::string>(), true, ""});
  if (has(json, "stages_left_out"))
    for (const auto& [stage, reason] : json["stages_left_out"].items())
      r.stages.push_back({stage, false, reason.get<std::string>()});
  if (has(json, "grid"))
    for (const Json& point : json["grid"])
      r.grid.push_back({point["r"].get<double>(), point["rho"].get<double>(),
                        point["iterations"].get<int>(), point["outcome"].get<std::string>()});
  if (has(json, "histories"))
    for (const auto& [what, residual] : json["histories"].items())
      r.histories.push_back({what, numbers_of(residual)});
}

}  // namespace

Record record_from_json(const Json& json) {
  Record record;
  read_what_was_solved(json, record);
  read_measures(json, record);
  read_outcome(json, record);
  read_lists(json, record);
  return record;
}

Json to_json(const TimedRun& run) {
  return {{"time_s", run.time_s},
          {"stages", json_of(run.stages)},
          {"status", std::string(name_of(run.status))},
          {"message", run.message},
          {"signal", run.signal},
          {"ended_in", run.ended_in},
          {"runs_s", run.runs_s}};
}

TimedRun timed_run_from_json(const Json& json) {
  TimedRun run;
  read(json, "time_s", run.time_s);
  if (has(json, "stages")) run.stages = stage_times_of(json["stages"]);
  if (has(json, "status")) run.status = status_of(json["status"].get<std::string>());
  read(json, "message", run.message);
  read(json, "signal", run.signal);
  read(json, "ended_in", run.ended_in);
  read(json, "runs_s", run.runs_s);
  return run;
}

}  // namespace airybench
