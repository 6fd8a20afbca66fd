#include "bench/records/summary.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/records/robust.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}
std::optional<double> median_of(const std::vector<double>& samples) {
  return if_finite(median(samples));
}

void set_interval(const std::optional<Interval>& interval, std::optional<double>& low,
                  std::optional<double>& high) {
  low = interval ? std::optional(interval->low) : std::nullopt;
  high = interval ? std::optional(interval->high) : std::nullopt;
}

void summarise_times(Record& r) {
  const std::vector<double>& samples = r.samples_s;
  r.repetitions = std::ssize(samples);
  r.time_s = median_of(samples);
  r.time_min_s = samples.empty() ? std::nullopt : std::optional(std::ranges::min(samples));
  r.time_mad_s = if_finite(median_absolute_deviation(samples));
  set_interval(samples.size() > 1 ? std::optional(bootstrap_median(samples)) : std::nullopt,
               r.time_low_s, r.time_high_s);
  set_interval(median_interval(samples), r.time_ci_low_s, r.time_ci_high_s);
  r.assembly_s = median_of(r.assembly_samples_s);
  r.program_s = median_of(r.program_samples_s);
  r.processor_s = median_of(r.processor_samples_s);
  r.program_solve_s = median_of(r.program_solve_samples_s);
  r.noise_kernel_s = median_of(r.noise_kernel_samples_s);
  r.busy_kernel_s = median_of(r.busy_kernel_samples_s);
}

void summarise_stages(Record& r) {
  for (const Field* field : fields_with(column)) {
    if (!std::string_view(field->name).starts_with("stage_")) continue;
    std::vector<double> times;
    for (const auto& run : r.stage_samples)
      for (const auto& [stage, seconds] : run)
        if ("stage_" + stage + "_s" == field->name) times.push_back(seconds);
    field->clear(r);
    if (!times.empty()) field->read(median(times), "a stage's median", field->name, r);
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

}  // namespace

std::string outcome_of(const Record& r) {
  const bool is_of_scene = r.outcome == name_of(Status::inaccurate);
  if (r.status == Status::inaccurate && r.claimed_status == Status::ok && !is_of_scene)
    return r.error_stress ? "wrong_success" : "unverified";
  return r.status == Status::ok && r.outcome == other_solution ? r.outcome
                                                               : std::string(name_of(r.status));
}

bool times_tie(const Record& a, const Record& b) {
  return a.time_low_s && b.time_low_s && *a.time_low_s <= *b.time_high_s &&
         *b.time_low_s <= *a.time_high_s;
}

bool meets(const std::optional<double>& error, double goal) {
  constexpr double rounding = 1e-6;
  return error && *error <= (1 + rounding) * goal;
}

bool misses_goal(const Record& r) {
  return r.adapt_goal && r.error_total && !meets(r.error_total, *r.adapt_goal);
}

std::optional<double> precision_of(const Record& record) {
  return parse_number(context_word(record, "precision"));
}

bool misses_precision(const Record& r) {
  const std::optional<double> asked = precision_of(r),
                              uncertainty = median_uncertainty(r.samples_s);
  return asked && r.time_s && !(uncertainty && *uncertainty <= *asked);
}

bool has_few_samples(const Record& record) {
  return std::ssize(record.samples_s) < fewest_to_tell_apart;
}

void summarise(Record& r) {
  summarise_times(r);
  summarise_stages(r);
  summarise_load_cases(r);
  r.outcome = outcome_of(r);
}

}  // namespace airybench
