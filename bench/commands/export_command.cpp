#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/report/history.hpp"
#include "bench/report/tracker_formats.hpp"
#include "support/atomic_file.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* export_footer = R"(
Formats  google-benchmark  Google Benchmark's JSON, for its compare.py and most trackers
         github-action     github-action-benchmark, tool customSmallerIsBetter
         bencher           Bencher Metric Format, adapter json
         csv               date,revision,mesh,scene,method,stop,quantity,value: a row per case and
                           number; of a history folder the whole series
         junit             JUnit XML: a case that is not ok fails, with its reason

DIR is a folder with records.jsonl; for csv also a history, a folder with nights/.

Exit status  0  written, whatever the cases' statuses
             2  wrong usage, or records that cannot be read: one line on standard error

Example
  {bench} export results/latest --format=bencher --out=bmf.json
)";

const std::vector<std::pair<std::string, std::string (*)(const std::vector<Record>&)>> formats = {
    {"google-benchmark", google_benchmark_json},
    {"github-action", github_action_json},
    {"bencher", bencher_json},
    {"csv", series_csv},
    {"junit", junit_xml}};

std::vector<Record> cases_of_history(const std::filesystem::path& folder) {
  std::vector<Record> cases;
  for (TrackedRun& run : read_history(folder))
    for (Record& record : run.cases) {
      record.context = run.context;
      record.context["date"] = run.date;
      cases.push_back(std::move(record));
    }
  if (cases.empty())
    throw RecordError(fmt::format("{}: no *.json in it (a folder that bench track wrote has them)",
                                  (folder / "nights").string()));
  return cases;
}

}  // namespace

int export_command(int argc, const char* const* argv) {
  std::filesystem::path folder, out;
  std::string format;
  CLI::App app("The records of a run in the format of another tool.", "{bench} export");
  app.footer(export_footer);
  app.add_option("DIR", folder, "folder with records.jsonl, or for csv with nights/")->required();
  app.add_option("--format", format, "of the formats below")
      ->required()
      ->check(CLI::IsMember(formats));
  app.add_option("--out", out, "file to write; default: standard output");
  parse_command_line(app, argc, argv);
  if (out.empty()) require_standard_output();

  std::error_code error;
  const bool is_history =
      format == "csv" && std::filesystem::is_directory(folder / "nights", error);
  const std::vector<Record> cases = is_history
                                        ? cases_of_history(folder)
                                        : read_records(records_file_in(folder), Studies::include);
  const auto found = std::ranges::find(formats, format, [](auto& f) { return f.first; });
  const std::string text = found->second(cases);
  if (out.empty())
    fmt::print("{}", text);
  else
    write_file_atomically(out, text);
  return 0;
}

}  // namespace airybench
