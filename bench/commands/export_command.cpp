#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/report/history.hpp"
#include "bench/report/junit.hpp"
#include "bench/report/tracker_formats.hpp"
#include "support/atomic_file.hpp"

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
  bench export results/latest --format=bencher --out=bmf.json
)";

struct ExportOptions {
  std::filesystem::path folder, out;
  std::string format;
};

ExportOptions parse_export(int argc, const char* const* argv) {
  ExportOptions options;
  CLI::App app("The records of a run in the format of another tool.", "bench export");
  app.footer(export_footer);
  app.add_option("DIR", options.folder, "folder with records.jsonl, or for csv with nights/")
      ->required();
  app.add_option("--format", options.format, "of the formats below")
      ->required()
      ->check(CLI::IsMember({"google-benchmark", "github-action", "bencher", "csv", "junit"}));
  app.add_option("--out", options.out, "file to write; default: standard output");
  parse_command_line(app, argc, argv);
  return options;
}

std::string exported(const std::string& format, const std::vector<Record>& cases) {
  if (format == "google-benchmark") return google_benchmark_json(cases);
  if (format == "github-action") return github_action_json(cases);
  if (format == "bencher") return bencher_json(cases);
  if (format == "junit") return junit_xml(cases);
  return series_csv(cases);
}

// The cases of all nights by date, each with its night's context.
std::vector<Record> cases_of_history(const std::filesystem::path& folder) {
  std::vector<Record> cases;
  for (Night& night : read_history(folder))
    for (Record& record : night.cases) {
      record.context = night.context;
      record.context["date"] = night.date;
      cases.push_back(std::move(record));
    }
  if (cases.empty())
    throw RecordError(fmt::format("{}: no *.json in it (a folder that bench track wrote has them)",
                                  (folder / "nights").string()));
  return cases;
}

}  // namespace

int export_command(int argc, const char* const* argv) {
  const ExportOptions options = parse_export(argc, argv);
  const bool history =
      options.format == "csv" && std::filesystem::is_directory(options.folder / "nights");
  const std::string text = exported(
      options.format, history ? cases_of_history(options.folder)
                              : read_records(records_file_in(options.folder), Studies::include));
  if (options.out.empty())
    fmt::print("{}", text);
  else
    write_file_atomically(options.out, text);
  return 0;
}

}  // namespace airybench
