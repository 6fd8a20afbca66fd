#include "bench/commands/commands.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "bench/commands/command_line.hpp"
#include "bench/records/csv.hpp"
#include "bench/records/google_benchmark.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/report/history.hpp"
#include "bench/report/results_table.hpp"
#include "solvers/methods.hpp"
#include "support/atomic_file.hpp"
#include "support/lists.hpp"
#include "support/messages.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* export_footer = R"(
Formats  google-benchmark  Google Benchmark's JSON, for its compare.py and most trackers
         csv               date,revision,mesh,scene,method,stop,quantity,value: a row per case and
                           number; of a history folder the whole series
         markdown          the table that bench prints, with a unit per column
         latex             the same as a tabular, for the package booktabs

Columns  all, case, mesh, scene, method, n_phi, n_c, W, time, ±, contact_law, without_self-check, heap,
         program, CPU, RSS, error_stress, error_force, natural_map, Siconos, error_total,
         penetration, between_nodes, tension, outside_friction_cone, unbalanced, adaptive_loop,
         status; case comes first unless one of the first four is chosen

DIR is a folder with records.jsonl; for csv also a history, a folder with nights/.

Exit status  0  written, whatever the cases' statuses
             2  wrong usage, or records that cannot be read: one line on standard error

Examples
  {bench} export results/latest --format=csv --out=series.csv
  {bench} export results/paper --format=latex --mesh=Mesh3 --columns=method,time,heap,error_force
)";

using Columns = std::vector<std::string>;
using Writer = std::string (*)(const std::vector<Record>&, const Columns&);

template <std::string (*write)(const std::vector<Record>&)>
std::string without_columns(const std::vector<Record>& cases, const Columns&) {
  return write(cases);
}
template <std::string (*write)(const PaperTable&)>
std::string as_table(const std::vector<Record>& cases, const Columns& columns) {
  return write(paper_table(cases, columns));
}

const std::vector<std::pair<std::string, Writer>> formats = {
    {"google-benchmark", without_columns<google_benchmark_json>},
    {"csv", without_columns<series_csv>},
    {"markdown", as_table<markdown_text>},
    {"latex", as_table<latex_text>}};

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

// Keeps the cases whose name, of a mesh or method, matches one of the globs.
void keep(std::vector<Record>& cases, const std::string& option,
          const std::vector<std::string>& globs, std::string Record::*name) {
  const auto matches = [&](const std::string& glob, const Record& record) {
    return fnmatch(glob.c_str(), (record.*name).c_str(), 0) == 0;
  };
  for (const std::string& glob : globs)
    if (std::ranges::none_of(cases, [&](const Record& r) { return matches(glob, r); })) {
      std::set<std::string> names;
      for (const Record& record : cases) names.insert(record.*name);
      throw UsageError(fmt::format("{}: no case has '{}' (there are: {})", option, glob,
                                   fmt::join(names, ", ")));
    }
  std::erase_if(cases, [&](const Record& record) {
    return std::ranges::none_of(globs, [&](const auto& glob) { return matches(glob, record); });
  });
}

}  // namespace

int export_command(int argc, const char* const* argv) {
  std::filesystem::path folder, out;
  std::string format, meshes, methods, columns;
  CLI::App app("The records of a run in the format of another tool.", "{bench} export");
  app.footer(export_footer);
  app.add_option("DIR", folder, "folder with records.jsonl, or for csv with nights/")->required();
  app.add_option("--format", format, "one of the formats below")
      ->required()
      ->check(CLI::IsMember(formats));
  app.add_option("--mesh", meshes, "names or globs; default: all of the records");
  app.add_option("--method", methods, "names or globs; default: all of the records");
  app.add_option("--columns", columns,
                 "columns of markdown and latex: names, or all; default: eight");
  app.add_option("--out", out, "file to write; default: standard output");
  parse_command_line(app, argc, argv);
  if (!columns.empty() && format != "markdown" && format != "latex")
    throw UsageError(
        fmt::format("--columns: not with --format={} (markdown and latex have them)", format));
  if (out.empty()) require_standard_output();

  std::error_code error;
  const bool is_history =
      format == "csv" && std::filesystem::is_directory(folder / "nights", error);
  std::vector<Record> cases = is_history ? cases_of_history(folder)
                                         : read_records(records_file_in(folder), Studies::include);
  if (!meshes.empty()) keep(cases, "--mesh", split_list(meshes), &Record::mesh);
  if (!methods.empty()) keep(cases, "--method", split_method_list(methods), &Record::method);
  const auto found = std::ranges::find(formats, format, [](auto& f) { return f.first; });
  const std::string text = found->second(cases, columns.empty() ? Columns() : split_list(columns));
  if (out.empty())
    print_data(text);
  else
    write_file_atomically(out, text);
  return 0;
}

}  // namespace airybench
