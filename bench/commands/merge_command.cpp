#include "bench/commands/merge_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

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
libraries, threads, tolerances and limits, and of one plan; each case may be there once, and every case of the plan must be
there. What is refused is named, and nothing is written then.

With --runs the folders are whole runs of different plans, which may differ in limits and repetitions, too; no case
may be there twice.

Meshes that lie in a run's folder (of --adapt, of models) are copied; fields and figures are not.

Exit status  0  joined
             2  refused, wrong usage, or records that cannot be read: one line on standard error

Example
  bench --shard=1/2 --out=part1    (and on another machine --shard=2/2 --out=part2)
  bench merge part1 part2 --out=results/whole
)";

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  bool incomplete = false, runs = false;
};

MergeOptions parse_merge(int argc, const char* const* argv) {
  MergeOptions options;
  CLI::App app("Joins the shards of a run, or several runs, into one results folder.",
               "bench merge");
  app.footer(merge_footer);
  app.add_option("DIR", options.folders, "folders with records.jsonl")->required();
  app.add_option("--out", options.out, "folder of the whole")->required();
  CLI::Option* incomplete =
      app.add_flag("--incomplete", options.incomplete, "also when cases of the plan are missing");
  app.add_flag("--runs", options.runs, "the folders are different runs, not shards of one")
      ->excludes(incomplete);
  parse_command_line(app, argc, argv);
  return options;
}

// Meshes in the folders of runs, by their paths from there, which are the same in the whole.
class OwnMeshes {
 public:
  // Throws FileError: another file of that path.
  void add(const std::string& path, const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return;  // a run may have been kept without its meshes
    const auto [there, is_new] = files_.emplace(path, file);
    if (is_new || there->second == file) return;  // another case of the same run
    if (sha256_of_file(there->second) != sha256_of_file(file))
      throw FileError(fmt::format("{} and {}: two meshes that would be one file of the whole",
                                  there->second.string(), file.string()));
  }
  void copy_to(const std::filesystem::path& folder) const {
    for (const auto& [path, file] : files_) {
      const std::filesystem::path copy = folder / path;
      make_folder(copy.parent_path());
      write_file_atomically(copy, file_text(file));
    }
  }

 private:
  std::map<std::string, std::filesystem::path> files_;
};

bool lies_in_its_folder(const std::filesystem::path& recorded) {
  return recorded.has_parent_path() && recorded.is_relative() &&
         *recorded.lexically_normal().begin() != "..";
}

// A path from a run's folder becomes one from the folder of the whole.
void name_mesh_from(const std::filesystem::path& out, const std::filesystem::path& folder,
                    OwnMeshes& meshes, RecordLine& line) {
  std::string& name = line.record.mesh_file;
  if (name.empty()) return;
  const std::filesystem::path file = recorded_file(name, folder);
  if (lies_in_its_folder(name))
    meshes.add(name, file);
  else
    name = recorded_path(file, out);
  line.json["mesh_file"] = name;
}

std::vector<RecordLine> read_all(const std::vector<std::filesystem::path>& folders,
                                 const std::filesystem::path& out, OwnMeshes& meshes) {
  std::vector<RecordLine> all;
  for (const auto& folder : folders)
    for (RecordLine& line : lines_in(folder)) {
      name_mesh_from(out, folder, meshes, line);
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

// By the case's number in the plan.
std::map<std::int64_t, RecordLine> by_number(const std::vector<RecordLine>& all) {
  std::map<std::int64_t, RecordLine> cases;
  for (const RecordLine& line : all) {
    const std::int64_t number = line.record.case_number.value_or(0);
    if (number < 1)
      throw FileError(fmt::format(
          "{}: case_number: {} (allowed: from 1; records of before there were shards do not join)",
          line.place, number));
    const auto [there, is_new] = cases.emplace(number, line);
    if (!is_new)
      throw FileError(fmt::format("{} and {}: both are case {}, {}", there->second.place,
                                  line.place, number, name_of(line.record).text()));
  }
  return cases;
}

// 0: the records are older than that word.
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

// In the plan's order.
std::vector<RecordLine> of_shards(const std::vector<RecordLine>& all, bool incomplete) {
  const std::map<std::int64_t, RecordLine> cases = by_number(all);
  // The same in all, or they would have been refused.
  const std::int64_t plan = cases_planned(all.front());
  std::string missing;
  int count = 0;
  for (std::int64_t number = 1; number <= plan; ++number)
    if (cases.count(number) == 0 && ++count <= 10)
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", number);
  if (count > 0 && !incomplete)
    throw FileError(
        fmt::format("{} of {} cases are missing: {}{} (go on with the shard by "
                    "--resume, or take --incomplete)",
                    count, plan, missing, count > 10 ? ", …" : ""));
  std::vector<RecordLine> lines;
  for (const auto& [number, line] : cases) lines.push_back(line);
  return lines;
}

// As they are named.
std::vector<RecordLine> of_runs(const std::vector<RecordLine>& all) {
  std::map<std::string, std::string> place_of;
  for (const RecordLine& line : all) {
    const std::string name = name_of(line.record).text();
    const auto [there, is_new] = place_of.emplace(name, line.place);
    if (!is_new)
      throw FileError(fmt::format("{} and {}: both are {}", there->second, line.place, name));
  }
  return all;
}

}  // namespace

int merge_command(int argc, const char* const* argv) {
  const MergeOptions options = parse_merge(argc, argv);
  OwnMeshes meshes;
  const std::vector<RecordLine> all = read_all(options.folders, options.out, meshes);
  refuse_mixtures(all, options.runs ? Sameness::different_runs : Sameness::same_sources);
  const std::vector<RecordLine> lines =
      options.runs ? of_runs(all) : of_shards(all, options.incomplete);
  write_records(options.out, lines);
  meshes.copy_to(options.out);
  fmt::print("{} records of {} folders in {}\n", lines.size(), options.folders.size(),
             options.out.string());
  return 0;
}

}  // namespace airybench
