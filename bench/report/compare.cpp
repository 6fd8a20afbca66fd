#include "bench/report/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "bench/records/robust.hpp"
#include "bench/report/mann_whitney.hpp"
#include "bench/report/multiple_testing.hpp"

namespace airybench {
namespace {

// One side's runs of one case, those that have it.
using CaseRuns = std::vector<const Record*>;

struct Side {
  std::vector<std::string> names;  // of the cases, in the order in which runs have them
  std::map<std::string, CaseRuns> cases;
};

Side side_of(const Runs& runs) {
  Side side;
  for (const std::vector<Record>& run : runs) {
    std::map<std::string, const Record*> last;
    for (const Record& record : run) {
      const std::string name = name_of(record).text();
      if (side.cases.try_emplace(name).second) side.names.push_back(name);
      last[name] = &record;
    }
    for (const auto& [name, record] : last) side.cases[name].push_back(record);
  }
  return side;
}

std::vector<std::string> names_only_in(const Side& side, const Side& other) {
  std::vector<std::string> names;
  std::copy_if(side.names.begin(), side.names.end(), std::back_inserter(names),
               [&](const std::string& name) { return !other.cases.contains(name); });
  return names;
}

const Record& telling(const CaseRuns& runs) {
  const auto broken = std::find_if(
      runs.begin(), runs.end(), [](const Record* record) { return record->status != Status::ok; });
  return broken == runs.end() ? *runs.back() : **broken;
}

std::vector<double> medians_of(const CaseRuns& runs) {
  std::vector<double> medians;
  for (const Record* record : runs)
    if (has_answer(record->status) && !record->samples_s.empty())
      medians.push_back(median(record->samples_s));
  return medians;
}

std::optional<double> kernel_time(const CaseRuns& runs) {
  std::vector<double> times;
  for (const Record* record : runs)
    if (record->noise_kernel_s) times.push_back(*record->noise_kernel_s);
  return times.empty() ? std::nullopt : std::optional(median(std::move(times)));
}

std::optional<double> drift_between(const Side& a, const Side& b) {
  std::vector<double> ratios;
  for (const auto& [name, runs] : a.cases) {
    if (!b.cases.contains(name)) continue;
    const auto before = kernel_time(runs), after = kernel_time(b.cases.at(name));
    if (before && after) ratios.push_back(*after / *before);
  }
  if (ratios.empty()) return {};
  return median(std::move(ratios));
}

// Runs that say no date, or begun within the same second, may have been in any order.
bool are_interleaved(const CaseRuns& a, const CaseRuns& b) {
  std::map<std::string, int> lead;  // date → runs of B begun then less those of A
  for (const Record* record : a) --lead[context_word(*record, "date")];
  for (const Record* record : b) ++lead[context_word(*record, "date")];
  int sum = 0;
  return !lead.contains("") && std::all_of(lead.begin(), lead.end(), [&](const auto& moment) {
    sum += moment.second;
    return std::abs(sum) <= 1;
  });
}

// Has the ratio gone up by enough? For the other direction with reciprocals.
bool exceeds(double ratio, double corrected, double drift, double minimum_effect) {
  return std::min(ratio, corrected) > 1 + minimum_effect && corrected > std::max(drift, 1 / drift);
}

TimeVerdict verdict_of(const ComparedCase& one, bool interleaved, double drift, std::size_t tests,
                       const CompareRules& rules) {
  const std::size_t m = one.medians_a.size(), n = one.medians_b.size();
  if (m == 1 && n == 1) return TimeVerdict::one_run_each;
  if (one.p > rules.level)
    return least_mann_whitney_p(m, n) * static_cast<double>(tests) > rules.level
               ? TimeVerdict::too_few_runs
               : TimeVerdict::not_separated;
  const bool slower = exceeds(one.ratio, one.corrected, drift, rules.minimum_effect);
  const bool faster = exceeds(1 / one.ratio, 1 / one.corrected, drift, rules.minimum_effect);
  if (!slower && !faster) return TimeVerdict::not_separated;
  if (!interleaved) return TimeVerdict::not_interleaved;
  return slower ? TimeVerdict::slower : TimeVerdict::faster;
}

std::optional<Interval> interval_of(const std::vector<double>& b, const std::vector<double>& a) {
  if (a.size() < 2 || b.size() < 2) return {};
  return bootstrap_ratio_of_medians(b, a);
}

void compare_means(Comparison& result) {
  std::vector<double> logs_a(result.runs_a), logs_b(result.runs_b);
  double cases = 0;
  for (const ComparedCase& one : result.cases) {
    if (one.medians_a.size() != logs_a.size() || one.medians_b.size() != logs_b.size()) continue;
    ++cases;
    for (std::size_t run = 0; run < logs_a.size(); ++run)
      logs_a[run] += std::log(one.medians_a[run]);
    for (std::size_t run = 0; run < logs_b.size(); ++run)
      logs_b[run] += std::log(one.medians_b[run]);
  }
  if (cases == 0) return;
  for (std::vector<double>* means : {&logs_a, &logs_b})
    for (double& mean : *means) mean = std::exp(mean / cases);
  result.mean_ratio = median(logs_b) / median(logs_a);
  result.mean_interval = interval_of(logs_b, logs_a);
}

}  // namespace

std::string_view name_of(TimeVerdict verdict) {
  constexpr std::array<std::string_view, 6> names = {"faster",
                                                     "slower",
                                                     "not separated",
                                                     "not separated: one run each",
                                                     "not separated: too few runs",
                                                     "not separated: runs not interleaved"};
  return names[static_cast<std::size_t>(verdict)];
}

bool Comparison::has_regression() const {
  return std::any_of(cases.begin(), cases.end(), [](const ComparedCase& one) {
    return one.broke() || (one.is_timed() && one.verdict == TimeVerdict::slower);
  });
}

Comparison compare(const Runs& a, const Runs& b, const CompareRules& rules) {
  Comparison result;
  result.rules = rules;
  result.runs_a = a.size();
  result.runs_b = b.size();
  const Side side_a = side_of(a), side_b = side_of(b);
  result.only_a = names_only_in(side_a, side_b);
  result.only_b = names_only_in(side_b, side_a);
  result.drift = drift_between(side_a, side_b);
  std::vector<double> p_values;
  for (const std::string& name : side_a.names) {
    if (!side_b.cases.contains(name)) continue;
    const CaseRuns &runs_a = side_a.cases.at(name), &runs_b = side_b.cases.at(name);
    ComparedCase one;
    one.a = telling(runs_a);
    one.b = telling(runs_b);
    one.medians_a = medians_of(runs_a);
    one.medians_b = medians_of(runs_b);
    if (one.is_timed()) {
      one.ratio = median(one.medians_b) / median(one.medians_a);
      one.corrected = one.ratio / result.drift.value_or(1);
      one.interval = interval_of(one.medians_b, one.medians_a);
      p_values.push_back(mann_whitney(one.medians_a, one.medians_b).p);
    }
    result.cases.push_back(std::move(one));
  }
  result.timed = p_values.size();
  if (result.timed == 0) return result;
  compare_means(result);
  result.runs_needed = values_needed_for(rules.level / static_cast<double>(result.timed));
  const std::vector<double> adjusted = holm_adjusted(p_values);
  std::size_t k = 0;
  for (ComparedCase& one : result.cases) {
    if (!one.is_timed()) continue;
    one.p = adjusted[k++];
    const std::string name = name_of(one.a).text();
    one.verdict = verdict_of(one, are_interleaved(side_a.cases.at(name), side_b.cases.at(name)),
                             result.drift.value_or(1), result.timed, rules);
  }
  return result;
}

}  // namespace airybench
