#include "bench/report/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "bench/records/context.hpp"
#include "bench/records/json_value.hpp"
#include "bench/records/robust.hpp"
#include "support/atomic_file.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "airybench-night-1";
constexpr std::array<std::string_view, 4> lane_names = {"status", "counters", "errors", "times"};
constexpr std::array<std::string_view, 3> kind_names = {"worse", "better", "changed"};

Json to_json(const Finding& finding) {
  return {{"case", finding.case_name},    {"lane", name_of(finding.lane)},
          {"quantity", finding.quantity}, {"before", finding.before},
          {"after", finding.after},       {"kind", name_of(finding.kind)},
          {"since", finding.since},       {"ratio", or_null(finding.ratio)},
          {"low", or_null(finding.low)},  {"high", or_null(finding.high)},
          {"sentence", finding.sentence}};
}

Finding finding_of(const JsonValue& verdict) {
  const auto text = [&](const char* key) { return verdict[key].as<std::string>("a text"); };
  const auto any = [&](const char* key) { return verdict.json.value(key, Json()); };
  const auto number = [&](const char* key) {
    return any(key).is_null() ? std::nullopt
                              : std::optional(verdict[key].as<double>("a number, null"));
  };
  const auto place = [&](const char* key, const auto& names) {
    return &verdict[key].one_of(names) - names.data();
  };
  return {text("case"),     static_cast<Lane>(place("lane", lane_names)),
          text("quantity"), any("before"),
          any("after"),     static_cast<Kind>(place("kind", kind_names)),
          text("since"),    number("ratio"),
          number("low"),    number("high"),
          text("sentence")};
}

bool is_date(const std::string& text) {
  return std::ranges::equal(
      text, std::string_view("dddd-dd-ddTdd:dd:ddZ"),
      [](char c, char expected) { return expected == 'd' ? c >= '0' && c <= '9' : c == expected; });
}

}  // namespace

std::string_view name_of(Lane lane) { return lane_names[static_cast<std::size_t>(lane)]; }
std::string_view name_of(Kind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

const Record* TrackedRun::find(const std::string& case_name) const {
  const auto found = std::ranges::find_if(
      cases, [&](const Record& record) { return name_of(record).text() == case_name; });
  return found == cases.end() ? nullptr : &*found;
}

std::string TrackedRun::machine() const {
  return fmt::format("{}, {} processors, {} threads", context_word(context, "cpu"),
                     context_word(context, "cpus"), context_word(context, "threads"));
}

TrackedRun tracked_run_of(std::vector<Record> records, const std::string& source) {
  if (records.empty()) throw RecordError(source + ": no records (a night needs some)");
  TrackedRun run;
  run.context = records.front().context;
  run.date = context_word(run.context, "date");
  if (!is_date(run.date))
    throw RecordError(fmt::format("{}:1: context: date: \"{}\" (allowed: as 2026-11-21T03:00:00Z)",
                                  source, run.date));
  for (const Record& record : records)
    if (record.noise_kernel_s) run.noise_samples_s.push_back(*record.noise_kernel_s);
  run.cases = std::move(records);
  return run;
}

TrackedRun parse_tracked_run(const std::string& text, const fs::path& file) {
  const std::string place = file.string();
  Json json;
  try {
    json = parse_json(text);
  } catch (const Json::exception& wrong) {
    throw RecordError(fmt::format("{}: not a whole night: {} (mend or remove the file)", place,
                                  without_prefix(wrong)));
  }
  const JsonValue all(place, "", json);
  const auto list = [&](const char* key) -> const Json& {
    const JsonValue value = all[key];
    if (!value.json.is_array()) value.fail("a list");
    return value.json;
  };
  all["format"].one_of(std::array{format_name});
  TrackedRun run;
  run.file = file;
  read(all["date"], run.date);
  if (!is_date(run.date)) all["date"].fail("as 2026-11-21T03:00:00Z");
  run.context = all["context"].as<std::map<std::string, std::string>>("an object of texts");
  run.noise_samples_s = all["noise"]["samples_s"].as<std::vector<double>>("a list of numbers");
  for (const Json& one : list("cases"))
    run.cases.push_back(record_of(one, fmt::format("{}: case {}", place, run.cases.size() + 1)));
  for (const Json& one : list("verdicts"))
    run.findings.push_back(
        finding_of({place, fmt::format("verdict {}", run.findings.size() + 1), one}));
  read(all["failed"], run.failed);
  run.times_judged = true;  // old files lack it
  all.take({key("times_judged", run.times_judged)});
  return run;
}

std::vector<TrackedRun> read_history(const fs::path& folder) {
  std::vector<TrackedRun> runs;
  const fs::path files = folder / "nights";
  std::error_code error;
  if (!fs::exists(files, error)) return runs;
  if (!fs::is_directory(files, error)) throw RecordError(files.string() + ": not a folder");
  for (const auto& entry : fs::directory_iterator(files))
    if (entry.path().extension() == ".json")
      runs.push_back(parse_tracked_run(file_text(entry.path()), entry.path()));
  std::ranges::sort(runs, {}, [](const TrackedRun& run) { return std::tie(run.date, run.file); });
  return runs;
}

fs::path file_for(const TrackedRun& run, const fs::path& folder,
                  const std::vector<TrackedRun>& history) {
  int of_this_second = 0;
  for (const TrackedRun& other : history) {
    if (other.date != run.date) continue;
    ++of_this_second;
    if (std::ranges::equal(
            run.cases, other.cases, {},
            [](const Record& record) { return to_json(record, nightly); },
            [](const Record& record) { return to_json(record, nightly); }))
      throw RecordError(
          fmt::format("{}: these records are already in the history", other.file.string()));
  }
  std::string name = run.date;
  std::erase(name, ':');
  if (of_this_second > 0) name += fmt::format("-{}", of_this_second + 1);
  return folder / "nights" / (name + ".json");
}

void write_tracked_run(const TrackedRun& run) {
  const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json cases = Json::array(), verdicts = Json::array();
  for (const Record& record : run.cases) cases.push_back(to_json(record, nightly));
  for (const Finding& finding : run.findings) verdicts.push_back(to_json(finding));
  const Json json = {{"format", format_name},
                     {"date", run.date},
                     {"context", run.context},
                     {"noise",
                      {{"median_s", finite(median(run.noise_samples_s))},
                       {"mad_s", finite(median_absolute_deviation(run.noise_samples_s))},
                       {"samples_s", run.noise_samples_s}}},
                     {"cases", cases},
                     {"verdicts", verdicts},
                     {"failed", run.failed},
                     {"times_judged", run.times_judged}};
  make_folder(run.file.parent_path());
  write_file_atomically(run.file, indented_json_text(json, 1) + "\n");
}

}  // namespace airybench
