#include "bench/commands/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "bench/commands/command_line.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/records/record_files.hpp"
#include "support/atomic_file.hpp"
#include "support/file_text.hpp"
#include "support/numbers.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr const char* merge_footer = R"(
The records must be of the same kind of machine (CPU model and number), of the same sources, compiler,
libraries, threads, tolerances and limits, and of one plan, with every case of the plan once. An error names the difference; then
nothing is written.

With --runs the folders are whole runs of different plans, which may differ in limits and repetitions; no case may occur
twice, and every plan must be complete.

Meshes that lie in a run's folder (of --adapt, of models) are copied; fields and figures are not.

Exit status  0  joined
             2  refused, wrong usage, or records that cannot be read: one line on standard error

Example
  {bench} --shard=1/2 --out=part1    (and on another machine --shard=2/2 --out=part2)
  {bench} merge part1 part2 --out=results/whole
)";

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  bool incomplete = false, runs = false;
};

MergeOptions parse_merge(int argc, const char* const* argv) {
  MergeOptions options;
  CLI::App app("Joins the shards of a run, or several runs, into one results folder.",
               "{bench} merge");
  app.footer(merge_footer);
  app.add_option("DIR", options.folders, "folders with records.jsonl")->required();
  app.add_option("--out", options.out, "folder to write")->required();
  app.add_flag("--incomplete", options.incomplete, "accept plans with missing cases");
  app.add_flag("--runs", options.runs, "the folders are different runs, not shards of one");
  parse_command_line(app, argc, argv);
  return options;
}

bool lies_in_its_folder(const std::filesystem::path& recorded) {
  return recorded.has_parent_path() && recorded.is_relative() &&
         *recorded.lexically_normal().begin() != "..";
}

// Path in the run's folder, and later in the result's, → mesh file of a run.
using OwnMeshes = std::map<std::string, std::filesystem::path>;

// Throws FileError if another file already has that path.
void add(const std::string& path, const std::filesystem::path& file, OwnMeshes& meshes) {
  if (!std::filesystem::exists(file)) return;  // meshes of the run were not kept
  const auto [there, is_new] = meshes.emplace(path, file);
  if (is_new || there->second == file) return;  // another case of the same run
  if (sha256_of_file(there->second) != sha256_of_file(file))
    throw FileError(fmt::format("{} and {}: two meshes that would be one file of the whole",
                                there->second.string(), file.string()));
}

// Makes mesh paths relative to the result's folder.
std::vector<RecordLine> read_all(const MergeOptions& options, OwnMeshes& meshes) {
  std::vector<RecordLine> all;
  for (const std::filesystem::path& folder : options.folders)
    for (RecordLine& line : lines_in(folder)) {
      std::string& mesh = line.record.mesh_file;
      const std::filesystem::path file = recorded_file(mesh, folder);
      if (lies_in_its_folder(mesh))
        add(mesh, file, meshes);
      else if (!mesh.empty())
        line.json["mesh_file"] = mesh = recorded_path(file, options.out);
      all.push_back(std::move(line));
    }
  if (all.empty()) throw FileError("the folders have no records");
  return all;
}

void refuse_mixtures(const std::vector<RecordLine>& all, Sameness sameness) {
  const RecordLine& first = all.front();
  for (const RecordLine& other : all) {
    const std::string differs = differences(first.record.context, other.record.context, sameness);
    if (!differs.empty())
      throw FileError(fmt::format("{} and {} do not mix: {}", first.place, other.place, differs));
  }
}

// 0 if the records are older than that word of the context.
std::int64_t cases_planned(const RecordLine& line) {
  constexpr std::int64_t most = 1'000'000;
  const std::string word = context_word(line.record, "cases_planned");
  if (word.empty()) return 0;
  const std::optional<std::int64_t> planned = parse_whole(word);
  if (!planned || *planned < 1 || *planned > most)
    throw FileError(
        fmt::format("{}: context: cases_planned: {} (allowed: a whole number from 1 to {})",
                    line.place, shortened(word), most));
  return *planned;
}

std::int64_t number_of(const RecordLine& line) {
  const std::int64_t number = line.record.case_number.value_or(0);
  if (number < 1)
    throw FileError(fmt::format(
        "{}: case_number: {} (allowed: from 1; records of before there were shards do not join)",
        line.place, number));
  return number;
}

// Throws FileError if a case is there twice: by its name, of shards by its number.
void refuse_twins(const std::vector<RecordLine>& all, bool runs) {
  std::map<std::pair<std::int64_t, std::string>, const RecordLine*> cases;
  for (const RecordLine& line : all) {
    const std::string name = name_of(line.record).text();
    const std::int64_t number = runs ? 0 : number_of(line);
    const auto [there, is_new] = cases.emplace(std::pair(number, runs ? name : ""), &line);
    if (!is_new)
      throw FileError(fmt::format("{} and {}: both are {}", there->second->place, line.place,
                                  runs ? name : fmt::format("case {}, {}", number, name)));
  }
}

// Throws FileError if cases of a plan are missing. Records that are older than plans pass.
void refuse_missing(const std::vector<RecordLine>& all) {
  constexpr int max_named = 10;
  std::map<std::string, std::pair<std::int64_t, std::set<std::int64_t>>> plans;
  for (const RecordLine& line : all) {
    auto& [planned, there] = plans[context_word(line.record, "plan_sha256")];
    planned = cases_planned(line);
    if (planned > 0) there.insert(number_of(line));
  }
  for (const auto& [plan, cases] : plans) {
    const auto& [planned, there] = cases;
    std::vector<std::string> missing;
    for (std::int64_t number = 1; number <= planned; ++number)
      if (!there.contains(number)) missing.push_back(std::to_string(number));
    const std::size_t count = missing.size();
    if (count == 0) continue;
    if (count > max_named) missing.resize(max_named);
    throw FileError(
        fmt::format("{} of {} cases are missing: {}{} (go on by --resume, or take "
                    "--incomplete)",
                    count, planned, fmt::join(missing, ", "), count > max_named ? ", …" : ""));
  }
}

}  // namespace

int merge_command(int argc, const char* const* argv) {
  const MergeOptions options = parse_merge(argc, argv);
  OwnMeshes meshes;
  std::vector<RecordLine> lines = read_all(options, meshes);
  refuse_mixtures(lines, options.runs ? Sameness::different_runs : Sameness::same_sources);
  refuse_twins(lines, options.runs);
  if (!options.incomplete) refuse_missing(lines);
  if (!options.runs) std::ranges::sort(lines, {}, number_of);
  check_takes_records(options.out);
  for (const auto& [path, file] : meshes) {
    make_folder((options.out / path).parent_path());
    write_file_atomically(options.out / path, file_text(file));
  }
  write_records(options.out, lines);
  fmt::print("{} records of {} folders in {}\n", lines.size(), options.folders.size(),
             options.out.string());
  return all_ok;
}

}  // namespace airybench
