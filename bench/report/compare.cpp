#include "bench/report/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/records/robust.hpp"
#include "bench/report/statistics.hpp"
#include "bench/report/track.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

using RecordList = std::vector<const Record*>;

struct CaseRuns {
  RecordList a, b;
};

const Record& telling(const RecordList& runs) {
  const auto broken =
      std::ranges::find_if(runs, [](const Record* record) { return record->status != Status::ok; });
  return broken == runs.end() ? *runs.back() : **broken;
}

constexpr const char* own_time = "program_solve_s";

// Of a program its own solve, unless a run does not have it: an older record.
bool has_own_time(const RecordList& runs) {
  return std::ranges::all_of(runs, [](const Record* record) {
    return record->samples_s.empty() || !record->program_solve_samples_s.empty();
  });
}

std::vector<double> medians_of(const RecordList& runs, std::vector<double> Record::*samples) {
  std::vector<double> medians;
  for (const Record* record : runs)
    if (has_answer(record->status) && !(record->*samples).empty())
      medians.push_back(median(record->*samples));
  return medians;
}

// NaN: the kernel was not timed.
double kernel_time(const RecordList& runs) {
  std::vector<double> times;
  for (const Record* record : runs)
    if (record->noise_kernel_s) times.push_back(*record->noise_kernel_s);
  return median(std::move(times));
}

// Runs without a date or of the same second may have any order.
bool are_interleaved(const CaseRuns& runs) {
  std::map<std::string, int> lead;  // date → runs of B minus runs of A
  for (const Record* record : runs.a) --lead[context_word(*record, "date")];
  for (const Record* record : runs.b) ++lead[context_word(*record, "date")];
  int sum = 0;
  return !lead.contains("") && std::ranges::all_of(lead, [&](const auto& moment) {
    sum += moment.second;
    return std::abs(sum) <= 1;
  });
}

// For the other direction, pass reciprocals.
bool exceeds(double ratio, double corrected, double drift, double minimum_effect) {
  return std::min(ratio, corrected) > 1 + minimum_effect && corrected > std::max(drift, 1 / drift);
}

TimeVerdict verdict_of(const ComparedCase& one, const Comparison& all) {
  const std::size_t m = one.medians_a.size(), n = one.medians_b.size();
  if (m == 1 && n == 1) return TimeVerdict::one_run_each;
  if (one.p > all.rules.level)
    return min_mann_whitney_p(m, n) * static_cast<double>(all.timed) > all.rules.level
               ? TimeVerdict::too_few_runs
               : TimeVerdict::not_separated;
  const double drift = all.drift.value_or(1), effect = all.rules.minimum_effect;
  const bool slower = exceeds(one.ratio, one.corrected, drift, effect);
  const bool faster = exceeds(1 / one.ratio, 1 / one.corrected, drift, effect);
  if (!slower && !faster) return TimeVerdict::not_separated;
  if (!one.interleaved) return TimeVerdict::not_interleaved;
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

std::vector<std::string> other_changes(const ComparedCase& one) {
  std::vector<std::string> changes;
  const std::string name = name_of(one.a).text();
  if (one.a.status != one.b.status)
    changes.push_back(
        fmt::format("{}: status {} → {}", name, name_of(one.a.status), name_of(one.b.status)));
  for (const unsigned use : {error, counter})
    for (const Field* field : fields_with(use)) {
      const auto before = number_in(one.a, *field), after = number_in(one.b, *field);
      if (!before || !after || !(grew(*field, *before, *after) || grew(*field, *after, *before)))
        continue;
      changes.push_back(
          use == error ? fmt::format("{}: {} {:.3g} → {:.3g}", name, field->name, *before, *after)
                       : fmt::format("{}: {} {:.0f} → {:.0f}", name, field->name, *before, *after));
    }
  return changes;
}

std::string interval_text(const std::optional<Interval>& interval) {
  return interval ? fmt::format("[{:.3g}, {:.3g}]", interval->low, interval->high) : "-";
}

Json interval_json(const std::optional<Interval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json();
}

bool is_own_time(const ComparedCase& one) { return one.time == std::string_view(own_time); }

// The column `time` is there where a case is a program's.
std::vector<std::vector<std::string>> table_of(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows = {
      {"case", "time", "A", "B", "B/A", "95 %", "/drift", "p", "verdict"}};
  for (const ComparedCase& one : comparison.cases) {
    std::vector<std::string>& row = rows.emplace_back(rows.front().size());
    row[0] = name_of(one.a).text();
    row[1] = is_own_time(one) ? "program's own solve" : "whole solve";
    row.back() = fmt::format("no times: {}, {}", name_of(one.a.status), name_of(one.b.status));
    if (one.is_timed())
      row = {row[0],
             row[1],
             show_seconds(median(one.medians_a)),
             show_seconds(median(one.medians_b)),
             fmt::format("{:.3g}", one.ratio),
             interval_text(one.interval),
             comparison.drift ? fmt::format("{:.3g}", one.corrected) : "-",
             fmt::format("{:.2g}", one.p),
             std::string(name_of(one.verdict))};
  }
  if (std::ranges::none_of(comparison.cases, is_own_time))
    for (std::vector<std::string>& row : rows) row.erase(row.begin() + 1);
  return rows;
}

std::vector<std::string> summary(const Comparison& comparison) {
  const auto count_of = [&](TimeVerdict verdict) {
    return std::ranges::count_if(comparison.cases, [&](const ComparedCase& one) {
      return one.is_timed() && one.verdict == verdict;
    });
  };
  const auto faster = count_of(TimeVerdict::faster), slower = count_of(TimeVerdict::slower);
  std::vector<std::string> lines = {
      fmt::format("B is faster in {} cases, slower in {}, not separated from A in {}", faster,
                  slower, static_cast<std::ptrdiff_t>(comparison.timed) - faster - slower)};
  if (comparison.mean_ratio)
    lines.push_back(fmt::format("geometric mean of B/A: {:.4g} {}", *comparison.mean_ratio,
                                interval_text(comparison.mean_interval)));
  if (comparison.drift)
    lines.push_back(fmt::format("drift of the machine: {:.4g} (the reference kernel's time, B/A)",
                                *comparison.drift));
  else
    lines.push_back("drift of the machine: not known (no noise_kernel_s in both)");
  if (count_of(TimeVerdict::one_run_each) + count_of(TimeVerdict::too_few_runs) > 0)
    lines.push_back(fmt::format(
        "{} runs of A, {} of B: with {} cases {} interleaved runs on both sides would "
        "do (repetitions within a run are not independent)",
        comparison.runs_a, comparison.runs_b, comparison.timed, comparison.runs_needed));
  if (count_of(TimeVerdict::not_interleaved) > 0)
    lines.push_back(
        "runs not interleaved: by their dates one side had at some time two runs more than the "
        "other; run A, B, A, B, …");
  for (const std::string& name : comparison.only_a) lines.push_back("only in A: " + name);
  for (const std::string& name : comparison.only_b) lines.push_back("only in B: " + name);
  for (const ComparedCase& one : comparison.cases)
    std::ranges::move(other_changes(one), std::back_inserter(lines));
  return lines;
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

Comparison compare(const Runs& a, const Runs& b, const CompareRules& rules) {
  Comparison result;
  result.rules = rules;
  result.runs_a = a.size();
  result.runs_b = b.size();
  std::vector<std::string> names;  // in order of appearance, A first
  std::map<std::string, CaseRuns> cases;
  const auto add = [&](const Runs& runs, RecordList CaseRuns::*side) {
    for (const std::vector<Record>& run : runs) {
      std::map<std::string, const Record*> last;
      for (const Record& record : run) {
        const std::string name = name_of(record).text();
        if (cases.try_emplace(name).second) names.push_back(name);
        last[name] = &record;
      }
      for (const auto& [name, record] : last) (cases[name].*side).push_back(record);
    }
  };
  add(a, &CaseRuns::a);
  add(b, &CaseRuns::b);
  std::vector<double> p_values, drifts;
  for (const std::string& name : names) {
    const CaseRuns& runs = cases.at(name);
    if (runs.a.empty() || runs.b.empty()) {
      (runs.b.empty() ? result.only_a : result.only_b).push_back(name);
      continue;
    }
    ComparedCase& one = result.cases.emplace_back();
    one.a = telling(runs.a);
    one.b = telling(runs.b);
    const bool is_program = !one.a.program.empty() && has_own_time(runs.a) && has_own_time(runs.b);
    const auto samples = is_program ? &Record::program_solve_samples_s : &Record::samples_s;
    if (is_program) one.time = own_time;
    one.medians_a = medians_of(runs.a, samples);
    one.medians_b = medians_of(runs.b, samples);
    one.interleaved = are_interleaved(runs);
    const double drift = kernel_time(runs.b) / kernel_time(runs.a);
    if (!std::isnan(drift)) drifts.push_back(drift);
    if (!one.is_timed()) continue;
    one.ratio = median(one.medians_b) / median(one.medians_a);
    one.interval = interval_of(one.medians_b, one.medians_a);
    p_values.push_back(mann_whitney(one.medians_a, one.medians_b).p);
  }
  if (!drifts.empty()) result.drift = median(drifts);
  result.timed = p_values.size();
  if (result.timed == 0) return result;
  compare_means(result);
  result.runs_needed = values_needed_for(rules.level / static_cast<double>(result.timed));
  const std::vector<double> adjusted = holm_adjusted(p_values);
  auto p = adjusted.begin();
  for (ComparedCase& one : result.cases) {
    if (!one.is_timed()) continue;
    one.p = *p++;
    one.corrected = one.ratio / result.drift.value_or(1);
    one.verdict = verdict_of(one, result);
  }
  return result;
}

bool Comparison::has_regression() const {
  return std::ranges::any_of(cases, [](const ComparedCase& one) {
    return one.broke() || (one.is_timed() && one.verdict == TimeVerdict::slower);
  });
}

std::string Comparison::text() const {
  const auto rows = table_of(*this);
  return fmt::format("{}\n{}\n", aligned_table(rows, rows.front().size()),
                     fmt::join(summary(*this), "\n"));
}

std::string Comparison::markdown() const {
  const std::vector<std::vector<std::string>> rows = table_of(*this);
  std::vector<std::string> lines;
  for (const auto& row : rows) lines.push_back(fmt::format("| {} |", fmt::join(row, " | ")));
  std::string rule = "|";
  for (std::size_t k = 0; k < rows.front().size(); ++k) rule += "---|";
  lines.insert(lines.begin() + 1, rule);
  return fmt::format("{}\n\n- {}\n", fmt::join(lines, "\n"), fmt::join(summary(*this), "\n- "));
}

Json Comparison::json() const {
  Json compared = Json::array();
  for (const ComparedCase& one : cases) {
    Json json = {{"case", name_of(one.a).text()},
                 {"status_a", name_of(one.a.status)},
                 {"status_b", name_of(one.b.status)},
                 {"other_changes", other_changes(one)}};
    if (one.is_timed())
      json.update(Json{{"time", one.time},
                       {"medians_a_s", one.medians_a},
                       {"medians_b_s", one.medians_b},
                       {"ratio", one.ratio},
                       {"interval", interval_json(one.interval)},
                       {"ratio_by_drift", one.corrected},
                       {"p_holm", one.p},
                       {"verdict", name_of(one.verdict)}});
    compared.push_back(std::move(json));
  }
  return {{"drift", or_null(drift)},
          {"minimum_effect", rules.minimum_effect},
          {"geometric_mean",
           mean_ratio ? Json{{"ratio", *mean_ratio}, {"interval", interval_json(mean_interval)}}
                      : Json()},
          {"runs_a", runs_a},
          {"runs_b", runs_b},
          {"cases", compared},
          {"only_in_a", only_a},
          {"only_in_b", only_b},
          {"regression", has_regression()}};
}

}  // namespace airybench
