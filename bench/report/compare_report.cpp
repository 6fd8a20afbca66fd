#include "bench/report/compare_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/records/json.hpp"
#include "bench/records/robust.hpp"
#include "bench/report/judge_counters.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

// Status, errors, memory, iterations: what is not equal.
std::vector<std::string> other_changes(const ComparedCase& one) {
  std::vector<std::string> changes;
  const std::string name = name_of(one.a).text();
  if (one.a.status != one.b.status)
    changes.push_back(
        fmt::format("{}: status {} → {}", name, name_of(one.a.status), name_of(one.b.status)));
  for (const Field* field : fields_with(error)) {
    const auto before = number_in(one.a, *field), after = number_in(one.b, *field);
    if (before && after && (error_grew(*before, *after) || error_grew(*after, *before)))
      changes.push_back(fmt::format("{}: {} {:.3g} → {:.3g}", name, field->name, *before, *after));
  }
  for (const JudgedCount& count : judged_counts()) {
    const auto before = count.in(one.a), after = count.in(one.b);
    if (before && after &&
        (count_grew(count, *before, *after) || count_grew(count, *after, *before)))
      changes.push_back(fmt::format("{}: {} {} → {}", name, count.field->name, *before, *after));
  }
  return changes;
}

std::string interval_text(const std::optional<Interval>& interval) {
  return interval ? fmt::format("[{:.3g}, {:.3g}]", interval->low, interval->high) : "-";
}

Json interval_json(const std::optional<Interval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json();
}

// The cells of a row; those of a case without times say so.
std::vector<std::string> row(const ComparedCase& one, bool drift_is_known) {
  if (!one.is_timed())
    return {name_of(one.a).text(),
            "",
            "",
            "",
            "",
            "",
            "",
            fmt::format("no times: {}, {}", name_of(one.a.status), name_of(one.b.status))};
  return {name_of(one.a).text(),
          show_seconds(median(one.medians_a)),
          show_seconds(median(one.medians_b)),
          fmt::format("{:.3g}", one.ratio),
          interval_text(one.interval),
          drift_is_known ? fmt::format("{:.3g}", one.corrected) : "-",
          fmt::format("{:.2g}", one.p),
          std::string(name_of(one.verdict))};
}
const std::vector<std::string> header = {"case", "A", "B", "B/A", "95 %", "/drift", "p", "verdict"};

bool any_is(const Comparison& comparison, TimeVerdict verdict) {
  return std::any_of(
      comparison.cases.begin(), comparison.cases.end(),
      [&](const ComparedCase& one) { return one.is_timed() && one.verdict == verdict; });
}

std::vector<std::string> summary(const Comparison& comparison) {
  std::vector<std::string> lines;
  if (comparison.mean_ratio)
    lines.push_back(fmt::format("geometric mean of B/A: {:.4g} {}", *comparison.mean_ratio,
                                interval_text(comparison.mean_interval)));
  if (comparison.drift)
    lines.push_back(fmt::format("drift of the machine: {:.4g} (the reference kernel's time, B/A)",
                                *comparison.drift));
  else
    lines.push_back("drift of the machine: not known (no noise_kernel_s in both)");
  if (any_is(comparison, TimeVerdict::one_run_each) ||
      any_is(comparison, TimeVerdict::too_few_runs))
    lines.push_back(fmt::format(
        "{} runs of A, {} of B: with {} cases {} interleaved runs on both sides would "
        "do (repetitions within a run are not independent)",
        comparison.runs_a, comparison.runs_b, comparison.timed, comparison.runs_needed));
  if (any_is(comparison, TimeVerdict::not_interleaved))
    lines.push_back(
        "runs not interleaved: by their dates one side had at some time two runs more than the "
        "other; run A, B, A, B, …");
  for (const std::string& name : comparison.only_a) lines.push_back("only in A: " + name);
  for (const std::string& name : comparison.only_b) lines.push_back("only in B: " + name);
  for (const ComparedCase& one : comparison.cases)
    for (std::string& change : other_changes(one)) lines.push_back(std::move(change));
  return lines;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::vector<std::vector<std::string>> rows = {header};
  for (const ComparedCase& one : comparison.cases)
    rows.push_back(row(one, comparison.drift.has_value()));
  std::string text = aligned_table(rows, header.size()) + "\n";
  for (const std::string& line : summary(comparison)) text += line + "\n";
  return text;
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text =
      fmt::format("| {} |\n|{}\n", fmt::join(header, " | "), "---|---|---|---|---|---|---|---|");
  for (const ComparedCase& one : comparison.cases)
    text += fmt::format("| {} |\n", fmt::join(row(one, comparison.drift.has_value()), " | "));
  text += "\n";
  for (const std::string& line : summary(comparison)) text += fmt::format("- {}\n", line);
  return text;
}

Json comparison_json(const Comparison& comparison) {
  Json cases = Json::array();
  for (const ComparedCase& one : comparison.cases) {
    Json json = {{"case", name_of(one.a).text()},
                 {"status_a", name_of(one.a.status)},
                 {"status_b", name_of(one.b.status)},
                 {"other_changes", other_changes(one)}};
    if (one.is_timed())
      json.update(Json{{"medians_a_s", one.medians_a},
                       {"medians_b_s", one.medians_b},
                       {"ratio", one.ratio},
                       {"interval", interval_json(one.interval)},
                       {"ratio_by_drift", one.corrected},
                       {"p_holm", one.p},
                       {"verdict", name_of(one.verdict)}});
    cases.push_back(std::move(json));
  }
  return {{"drift", comparison.drift ? Json(*comparison.drift) : Json()},
          {"minimum_effect", comparison.rules.minimum_effect},
          {"geometric_mean", comparison.mean_ratio
                                 ? Json{{"ratio", *comparison.mean_ratio},
                                        {"interval", interval_json(comparison.mean_interval)}}
                                 : Json()},
          {"runs_a", comparison.runs_a},
          {"runs_b", comparison.runs_b},
          {"cases", cases},
          {"only_in_a", comparison.only_a},
          {"only_in_b", comparison.only_b},
          {"regression", comparison.has_regression()}};
}

}  // namespace airybench
