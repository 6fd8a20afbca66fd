#include "bench/records/summary.hpp"

#include <algorithm>
#include <cmath>

#include "bench/records/bootstrap.hpp"
#include "bench/records/median_interval.hpp"
#include "bench/records/robust.hpp"

namespace airybench {
namespace {

std::optional<double> median_of(const std::vector<double>& samples) {
  const double value = median(samples);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void summarise_times(Record& r) {
  const std::vector<double>& samples = r.samples_s;
  r.repetitions = static_cast<std::int64_t>(samples.size());
  r.time_s = median_of(samples);
  r.time_min_s.reset();
  r.time_mad_s.reset();
  if (!samples.empty()) {
    r.time_min_s = *std::min_element(samples.begin(), samples.end());
    r.time_mad_s = median_absolute_deviation(samples);
  }
  const Interval interval = samples.size() > 1 ? bootstrap_median(samples) : Interval{};
  r.time_low_s = interval.low > 0 ? std::optional(interval.low) : std::nullopt;
  r.time_high_s = interval.low > 0 ? std::optional(interval.high) : std::nullopt;
  const std::optional<Interval> ordered = median_interval(samples);
  r.time_ci_low_s = ordered ? std::optional(ordered->low) : std::nullopt;
  r.time_ci_high_s = ordered ? std::optional(ordered->high) : std::nullopt;
  const std::optional<double> uncertainty = median_uncertainty(samples);
  r.precision_reached = r.precision && uncertainty && *uncertainty <= *r.precision;
  r.assembly_s = median_of(r.assembly_samples_s);
  r.program_s = median_of(r.program_samples_s);
  r.noise_kernel_s = median_of(r.noise_kernel_samples_s);
  r.busy_kernel_s = median_of(r.busy_kernel_samples_s);
}

// A stage's median is over the runs that have it.
void summarise_stages(Record& r) {
  std::map<std::string, std::vector<double>> times_of;
  for (const auto& run : r.stage_samples)
    for (const auto& [stage, seconds] : run) times_of[column_of_stage(stage)].push_back(seconds);
  for (const Field* field : fields_with(column)) {
    if (!std::string_view(field->name).starts_with("stage_")) continue;
    field->clear(r);
    if (const auto found = times_of.find(field->name); found != times_of.end())
      field->read(median(found->second), "a stage's median", field->name, r);
  }
}

void summarise_load_cases(Record& r) {
  r.time_once_s.reset();
  r.time_per_load_s.reset();
  if (r.samples_s.size() != r.stage_samples.size()) return;
  std::vector<double> once, per_load;
  for (std::size_t run = 0; run < r.samples_s.size(); ++run) {
    double sum = 0;
    for (const char* stage : {"order", "precondition", "factor", "condense"})
      if (const auto found = r.stage_samples[run].find(stage); found != r.stage_samples[run].end())
        sum += found->second;
    once.push_back(sum);
    per_load.push_back(std::max(0.0, r.samples_s[run] - sum) /
                       static_cast<double>(r.load_steps.value_or(1)));
  }
  r.time_once_s = median_of(once);
  r.time_per_load_s = median_of(per_load);
}

void summarise_grid(Record& r) {
  if (r.grid.empty()) return;
  std::vector<double> iterations;
  r.grid_failures = 0;
  for (const Json& point : r.grid) {
    const auto count = point.at("iterations").get<std::int64_t>();
    if (point.at("outcome") == "diverged")
      ++*r.grid_failures;
    else if (count > 0)
      iterations.push_back(static_cast<double>(count));
    if (point.at("outcome") == "converged")
      r.grid_best = std::min(r.grid_best.value_or(count), count);
  }
  if (iterations.empty()) return;
  r.grid_median = static_cast<std::int64_t>(median(iterations));
  r.grid_worst = static_cast<std::int64_t>(*std::max_element(iterations.begin(), iterations.end()));
}

}  // namespace

std::string outcome_of(const Record& r) {
  const auto is_met = [&](const std::optional<double>& error) {
    return !error || (r.target_error && *error <= *r.target_error);
  };
  const bool is_of_the_mesh = r.error_discretisation.value_or(0) > 1 && is_met(r.error_stress) &&
                              is_met(r.error_force) && is_met(r.equilibrium_residual) &&
                              is_met(r.natural_map_residual);
  if (r.status == Status::inaccurate && r.claimed_status == Status::ok && !is_of_the_mesh)
    return r.error_stress ? "wrong_success" : "unverified";
  return r.other_solution ? "other_solution" : std::string(name_of(r.status));
}

std::string column_of_stage(const std::string& stage) { return "stage_" + stage + "_s"; }

void summarise(Record& r) {
  summarise_times(r);
  summarise_stages(r);
  summarise_load_cases(r);
  summarise_grid(r);
  r.outcome = outcome_of(r);
  // A displacement method has no algebraic error against the reference.
  if (r.error_discretisation && is_verified(r))
    r.error_total = *r.error_discretisation + r.error_stress.value_or(0);
}

}  // namespace airybench
