#include "bench/report/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/records/json.hpp"
#include "bench/records/robust.hpp"
#include "bench/report/judge_counters.hpp"

namespace airybench {
namespace {

constexpr const char* all_cases = "all cases";
constexpr const char* time_name = "time_s";

double log_time(const Record* record) {
  const bool has_time = record != nullptr && has_answer(record->status) && record->time_s;
  return has_time ? std::log(*record->time_s) : std::nan("");
}

// The first night after the last change of the case's time that an earlier night reported.
std::size_t start_of(const std::vector<Night>& nights, const std::string& case_name) {
  for (std::size_t t = nights.size() - 1; t-- > 0;)
    for (const Finding& finding : nights[t].findings)
      if (finding.lane == Lane::times && finding.case_name == case_name)
        return static_cast<std::size_t>(
            std::find_if(nights.begin(), nights.end(),
                         [&](const Night& night) { return night.date >= finding.since; }) -
            nights.begin());
  return 0;
}

TimeTable time_table(const std::vector<Night>& nights) {
  TimeTable table;
  for (const Record& now : nights.back().cases) {
    const std::string name = name_of(now).text();
    std::vector<double> series;
    for (const Night& night : nights) series.push_back(log_time(night.find(name)));
    table.log_times.push_back(std::move(series));
    table.starts.push_back(start_of(nights, name));
  }
  for (const Night& night : nights)
    table.log_kernel.push_back(std::log(median(night.noise_samples_s)));
  table.common_start = start_of(nights, all_cases);
  return table;
}

// Median of the measured times before and after the change, in seconds.
Json seconds(const std::vector<double>& log_times, std::size_t first, std::size_t end) {
  std::vector<double> times;
  for (std::size_t t = first; t < end; ++t)
    if (std::isfinite(log_times[t])) times.push_back(std::exp(log_times[t]));
  return times.empty() ? Json() : Json(median(std::move(times)));
}

Finding finding_of(const TimeChange& found, const TimeTable& table,
                   const std::vector<Night>& nights) {
  const Change& change = found.change;
  Finding finding;
  finding.lane = Lane::times;
  finding.quantity = time_name;
  finding.kind = change.shift > 0 ? Kind::worse : Kind::better;
  finding.since = nights[change.first].date;
  finding.ratio = std::exp(change.shift);
  finding.low = std::exp(change.low);
  finding.high = std::exp(change.high);
  std::string against = "the other cases";
  if (found.series) {
    const std::vector<double>& series = table.log_times[*found.series];
    finding.case_name = name_of(nights.back().cases[*found.series]).text();
    finding.before = seconds(series, table.starts[*found.series], change.first);
    finding.after = seconds(series, change.first, series.size());
    if (table.log_times.size() < least_cases) against = "the reference kernel";
  } else {
    finding.case_name = all_cases;
    against = "the reference kernel";
  }
  finding.sentence = fmt::format(
      "{}: {} since {}: {:.3g} times the time before (95 %: {:.3g} to {:.3g}), against {}.",
      finding.case_name, finding.kind == Kind::worse ? "slower" : "faster", finding.since,
      *finding.ratio, *finding.low, *finding.high, against);
  return finding;
}

}  // namespace

void judge_newest(std::vector<Night>& history, const TimeRules& rules) {
  Night& newest = history.back();
  std::vector<Night> nights;
  std::copy_if(history.begin(), history.end(), std::back_inserter(nights),
               [&](const Night& night) { return night.machine() == newest.machine(); });
  newest.times_judged = nights.size() >= nights_to_judge_times(rules);
  newest.findings = judge_counters(nights);
  const TimeTable table = time_table(nights);
  for (const TimeChange& change : find_time_changes(table, rules))
    newest.findings.push_back(finding_of(change, table, nights));
  newest.failed = std::any_of(newest.findings.begin(), newest.findings.end(),
                              [](const Finding& finding) { return finding.kind == Kind::worse; });
}

}  // namespace airybench
