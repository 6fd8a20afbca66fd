#include "bench/report/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/records/context.hpp"
#include "bench/records/robust.hpp"

namespace airybench {
namespace {

constexpr const char* all_cases = "all cases";

constexpr std::array library_keys = {"compiler", "compiler_flags", "build_type",
                                     "eigen",    "cholmod",        "mumps",
                                     "blas",     "blas_core",      "heap_probe"};

bool same_libraries(const TrackedRun& a, const TrackedRun& b) {
  return std::ranges::all_of(library_keys, [&](const char* key) {
    return context_word(a.context, key) == context_word(b.context, key);
  });
}

// The case in the last earlier run with has(run, record); null: none.
template <typename Has>
const Record* earlier(const std::vector<TrackedRun>& runs, const std::string& name,
                      const Has& has) {
  for (auto run = runs.rbegin() + 1; run != runs.rend(); ++run)
    if (const Record* record = run->find(name); record != nullptr && has(*run, *record))
      return record;
  return nullptr;
}

std::string shown(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : json_text(value);
}

Finding finding_of(const std::string& name, Lane lane, const char* quantity, const Json& before,
                   const Json& after, Kind kind, const std::string& date) {
  Finding finding{name, lane, quantity, before, after, kind, date, {}, {}, {}, ""};
  if (before.is_number() && before.get<double>() > 0)
    finding.ratio = after.get<double>() / before.get<double>();
  finding.sentence =
      fmt::format("{}: {} was {} and is {}{}.", name, quantity, shown(before), shown(after),
                  kind == Kind::changed ? "" : fmt::format(": {}", name_of(kind)));
  return finding;
}

void compare_case(const std::vector<TrackedRun>& runs, const Record& now,
                  std::vector<Finding>& findings) {
  const std::string name = name_of(now).text();
  const auto add = [&](Lane lane, const char* quantity, const Json& before, const Json& after,
                       Kind kind) {
    findings.push_back(finding_of(name, lane, quantity, before, after, kind, runs.back().date));
  };
  const Record* last = earlier(runs, name, [](const auto&, const auto&) { return true; });
  if (last == nullptr) return;
  if (last->status != now.status)
    add(Lane::status, "status", name_of(last->status), name_of(now.status),
        last->status == Status::ok ? Kind::worse
        : now.status == Status::ok ? Kind::better
                                   : Kind::changed);
  if (!has_answer(now.status)) return;  // counts of a run that was stopped are lower bounds
  bool another_error = false;
  for (const Lane lane : {Lane::counters, Lane::errors})
    for (const Field* field : fields_with(lane == Lane::counters ? counter : error)) {
      const auto after = number_in(now, *field);
      if (!after) continue;
      const Record* record = earlier(runs, name, [&](const TrackedRun& run, const Record& before) {
        return has_answer(before.status) && number_in(before, *field) &&
               ((field->use & of_libraries) == 0 || same_libraries(run, runs.back()));
      });
      if (record == nullptr) continue;
      const double before = *number_in(*record, *field);
      const bool worse = grew(*field, before, *after);
      if (!worse && !grew(*field, *after, before)) continue;
      add(lane, field->name, field->value(*record), field->value(now),
          worse ? Kind::worse : Kind::better);
      another_error = another_error || lane == Lane::errors;
    }
  if (another_error || now.answer_hash.empty()) return;
  const Record* record = earlier(
      runs, name, [](const auto&, const Record& before) { return !before.answer_hash.empty(); });
  if (record != nullptr && record->answer_hash != now.answer_hash)
    add(Lane::errors, "answer_hash", record->answer_hash, now.answer_hash, Kind::changed);
}

void compare_contexts(const TrackedRun& before, const TrackedRun& now,
                      std::vector<Finding>& findings) {
  for (const Record& record : before.cases)
    if (const std::string name = name_of(record).text(); now.find(name) == nullptr)
      findings.push_back(finding_of(name, Lane::status, "status", name_of(record.status), "not run",
                                    Kind::changed, now.date));
  constexpr const char* setting = "target_error";
  const auto had = context_word(before.context, setting), has = context_word(now.context, setting);
  if (!had.empty() && had != has) {
    findings.push_back(
        finding_of(all_cases, Lane::status, setting, had, has, Kind::changed, now.date));
    findings.back().sentence = fmt::format(
        "all cases: {} was {} and is {}: counters and errors follow it.", setting, had, has);
  }
  std::string changes;
  for (const char* key : library_keys)
    if (context_word(before.context, key) != context_word(now.context, key))
      changes += fmt::format("{}{}: {} → {}", changes.empty() ? "" : "; ", key,
                             context_word(before.context, key), context_word(now.context, key));
  if (changes.empty()) return;
  Finding& finding = findings.emplace_back(
      finding_of(all_cases, Lane::counters, "libraries", {}, {}, Kind::changed, now.date));
  finding.sentence = fmt::format(
      "all cases: new baseline for heap figures, as compiler or libraries changed ({}).", changes);
}

// The field whose level is judged. Nights before programs had theirs do not count for them: another
// time is no change of level.
const char* judged_time(const Record& record) {
  return record.program.empty() ? "time_s" : "program_solve_s";
}

double log_time(const Record* record) {
  if (record == nullptr || !has_answer(record->status)) return std::nan("");
  const std::optional<double> time_s = number_in(*record, field_named(judged_time(*record)));
  return time_s ? std::log(*time_s) : std::nan("");
}

// First run after the last reported change of the case's time.
std::size_t start_of(const std::vector<TrackedRun>& runs, const std::string& case_name) {
  for (std::size_t t = runs.size() - 1; t-- > 0;)
    for (const Finding& finding : runs[t].findings)
      if (finding.lane == Lane::times && finding.case_name == case_name)
        return static_cast<std::size_t>(
            std::ranges::find_if(runs,
                                 [&](const TrackedRun& run) { return run.date >= finding.since; }) -
            runs.begin());
  return 0;
}

TimeTable time_table(const std::vector<TrackedRun>& runs) {
  TimeTable table;
  for (const Record& now : runs.back().cases) {
    const std::string name = name_of(now).text();
    std::vector<double>& series = table.log_times.emplace_back();
    for (const TrackedRun& run : runs) series.push_back(log_time(run.find(name)));
    table.starts.push_back(start_of(runs, name));
  }
  for (const TrackedRun& run : runs)
    table.log_kernel.push_back(std::log(median(run.noise_samples_s)));
  table.common_start = start_of(runs, all_cases);
  return table;
}

Json median_time(const std::vector<double>& log_times, std::size_t first, std::size_t end) {
  std::vector<double> times;
  for (std::size_t t = first; t < end; ++t)
    if (std::isfinite(log_times[t])) times.push_back(std::exp(log_times[t]));
  return times.empty() ? Json() : Json(median(std::move(times)));
}

Finding finding_of(const TimeChange& change, const TimeTable& table,
                   const std::vector<TrackedRun>& runs) {
  Finding finding;
  finding.case_name = all_cases;
  finding.lane = Lane::times;
  finding.quantity = "time_s";
  finding.kind = change.shift > 0 ? Kind::worse : Kind::better;
  finding.since = runs[change.first].date;
  finding.ratio = std::exp(change.shift);
  finding.low = std::exp(change.low);
  finding.high = std::exp(change.high);
  if (change.series) {
    const std::vector<double>& series = table.log_times[*change.series];
    const Record& now = runs.back().cases[*change.series];
    finding.case_name = name_of(now).text();
    finding.quantity = judged_time(now);
    finding.before = median_time(series, table.starts[*change.series], change.first);
    finding.after = median_time(series, change.first, series.size());
  }
  const bool by_kernel = !change.series || table.log_times.size() < min_cases;
  finding.sentence = fmt::format(
      "{}: {}{} since {}: {:.3g} times the time before (95 %: {:.3g} to {:.3g}), against the {}.",
      finding.case_name, finding.quantity == "time_s" ? "" : "the program's own solve is ",
      finding.kind == Kind::worse ? "slower" : "faster", finding.since, *finding.ratio,
      *finding.low, *finding.high, by_kernel ? "reference kernel" : "other cases");
  return finding;
}

}  // namespace

bool grew(const Field& field, double before, double after) {
  if (field.use & error) return after > 1.01 * before && after - before > 1e-11;
  return after > before * (field.use & per_mille ? 1.001 : 1);
}

void track_newest(std::vector<TrackedRun>& history, const TimeRules& rules) {
  TrackedRun& newest = history.back();
  std::vector<TrackedRun> runs;
  std::ranges::copy_if(history, std::back_inserter(runs),
                       [&](const TrackedRun& run) { return run.machine() == newest.machine(); });
  newest.times_judged = runs.size() >= rules.min_runs();
  newest.findings.clear();
  if (runs.size() > 1) compare_contexts(runs[runs.size() - 2], newest, newest.findings);
  for (const Record& now : newest.cases) compare_case(runs, now, newest.findings);
  const TimeTable table = time_table(runs);
  for (const TimeChange& change : find_time_changes(table, rules))
    newest.findings.push_back(finding_of(change, table, runs));
  newest.failed = std::ranges::any_of(
      newest.findings, [](const Finding& finding) { return finding.kind == Kind::worse; });
}

}  // namespace airybench
