#include "bench/tracking/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/statistics/mann_whitney.hpp"
#include "bench/statistics/multiple_testing.hpp"
#include "bench/statistics/robust.hpp"

namespace airybench {
namespace {

using ByName = std::map<std::string, const Record*>;

ByName by_name(const std::vector<Record>& records) {
  ByName result;
  for (const Record& record : records) result[name_of(record).text()] = &record;
  return result;
}

std::vector<std::string> names_only_in(const std::vector<Record>& records, const ByName& others) {
  std::vector<std::string> names;
  for (const Record& record : records)
    if (const std::string name = name_of(record).text();
        !others.contains(name) && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

std::optional<double> drift_of(const std::vector<ComparedCase>& cases) {
  std::vector<double> ratios;
  for (const ComparedCase& one : cases)
    if (one.a.noise_kernel_s && one.b.noise_kernel_s)
      ratios.push_back(*one.b.noise_kernel_s / *one.a.noise_kernel_s);
  if (ratios.empty()) return {};
  return median(std::move(ratios));
}

bool is_timed(const Record& record) { return has_answer(record) && !record.samples_s.empty(); }

// Has the ratio gone up by enough? For the other direction with reciprocals.
bool exceeds(double ratio, double corrected, double drift, double minimum_effect) {
  return std::min(ratio, corrected) > 1 + minimum_effect && corrected > std::max(drift, 1 / drift);
}

TimeVerdict verdict_of(const ComparedCase& one, double drift, std::size_t tests,
                       const CompareRules& rules) {
  if (one.p <= rules.level) {
    if (exceeds(one.ratio, one.corrected, drift, rules.minimum_effect)) return TimeVerdict::slower;
    if (exceeds(1 / one.ratio, 1 / one.corrected, drift, rules.minimum_effect))
      return TimeVerdict::faster;
    return TimeVerdict::not_separated;
  }
  const double least = least_mann_whitney_p(one.a.samples_s.size(), one.b.samples_s.size());
  return least * static_cast<double>(tests) > rules.level ? TimeVerdict::too_few_samples
                                                          : TimeVerdict::not_separated;
}

}  // namespace

std::string_view name_of(TimeVerdict verdict) {
  constexpr std::array<std::string_view, 4> names = {"faster", "slower", "not separated",
                                                     "too few samples"};
  return names[static_cast<std::size_t>(verdict)];
}

bool Comparison::has_regression() const {
  return std::any_of(cases.begin(), cases.end(), [](const ComparedCase& one) {
    return one.broke() || (one.timed && one.verdict == TimeVerdict::slower);
  });
}

Comparison compare(const std::vector<Record>& a, const std::vector<Record>& b,
                   const CompareRules& rules) {
  Comparison result;
  result.rules = rules;
  const ByName in_a = by_name(a), in_b = by_name(b);
  result.only_a = names_only_in(a, in_b);
  result.only_b = names_only_in(b, in_a);
  std::vector<SamplePair> pairs;
  std::vector<double> p_values;
  double log_sum = 0;
  for (const Record& record : a) {
    const std::string name = name_of(record).text();
    const auto other = in_b.find(name);
    if (other == in_b.end() || in_a.at(name) != &record) continue;
    ComparedCase one;
    one.a = record;
    one.b = *other->second;
    one.timed = is_timed(one.a) && is_timed(one.b);
    if (one.timed) {
      one.ratio = median(one.b.samples_s) / median(one.a.samples_s);
      one.interval = bootstrap_ratio_of_medians(one.b.samples_s, one.a.samples_s);
      p_values.push_back(mann_whitney(one.a.samples_s, one.b.samples_s).p);
      pairs.push_back({one.b.samples_s, one.a.samples_s});
      log_sum += std::log(one.ratio);
    }
    result.cases.push_back(std::move(one));
  }
  result.timed = pairs.size();
  result.drift = drift_of(result.cases);
  if (pairs.empty()) return result;
  result.mean_ratio = std::exp(log_sum / static_cast<double>(pairs.size()));
  result.mean_interval = bootstrap_geometric_mean(pairs);
  result.repetitions_needed = values_needed_for(rules.level / static_cast<double>(pairs.size()));
  const std::vector<double> adjusted = holm_adjusted(p_values);
  const double drift = result.drift.value_or(1);
  std::size_t k = 0;
  for (ComparedCase& one : result.cases) {
    if (!one.timed) continue;
    one.p = adjusted[k++];
    one.corrected = one.ratio / drift;
    one.verdict = verdict_of(one, drift, pairs.size(), rules);
  }
  return result;
}

}  // namespace airybench
