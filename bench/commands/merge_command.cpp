#include "bench/commands/merge_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/commands/command_line.hpp"
#include "bench/output/record_files.hpp"

namespace airybench {
namespace {

constexpr const char* merge_footer = R"(
The records must be of the same kind of machine (CPU model and number), of the same sources, compiler,
libraries, threads, tolerances and limits, and of one plan; each case may be there once, and every case of the plan must be
there. What is refused is named, and nothing is written then.

Exit status  0  joined
             2  refused, wrong usage, or records that cannot be read: one line on standard error

Example
  bench --shard=1/2 --out=part1    (and on another machine --shard=2/2 --out=part2)
  bench merge part1 part2 --out=results/whole
)";

struct MergeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  bool incomplete = false;
};

MergeOptions parse_merge(int argc, const char* const* argv) {
  MergeOptions options;
  CLI::App app("Joins the shards of a run into one results folder.", "bench merge");
  app.footer(merge_footer);
  app.add_option("DIR", options.folders, "folders with records.jsonl")->required();
  app.add_option("--out", options.out, "folder of the whole")->required();
  app.add_flag("--incomplete", options.incomplete, "also when cases of the plan are missing");
  parse_command_line(app, argc, argv);
  return options;
}

std::vector<RecordLine> read_all(const std::vector<std::filesystem::path>& folders) {
  std::vector<RecordLine> all;
  for (const auto& folder : folders)
    for (RecordLine& line : lines_in(folder)) all.push_back(std::move(line));
  if (all.empty()) throw FileError("the folders have no records");
  return all;
}

void refuse_mixtures(const std::vector<RecordLine>& all) {
  const RecordLine& first = all.front();
  for (const RecordLine& other : all) {
    const std::string differs =
        differences(first.record.context, other.record.context, Sameness::same_sources);
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

}  // namespace

int merge_command(int argc, const char* const* argv) {
  const MergeOptions options = parse_merge(argc, argv);
  const std::vector<RecordLine> all = read_all(options.folders);
  refuse_mixtures(all);
  const std::map<std::int64_t, RecordLine> cases = by_number(all);
  // The same in all, or they would have been refused.
  const int plan = std::atoi(context_word(all.front().record, "cases_planned").c_str());
  std::string missing;
  int count = 0;
  for (int number = 1; number <= plan; ++number)
    if (cases.count(number) == 0 && ++count <= 10)
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", number);
  if (count > 0 && !options.incomplete)
    throw FileError(
        fmt::format("{} of {} cases are missing: {}{} (go on with the shard by "
                    "--resume, or take --incomplete)",
                    count, plan, missing, count > 10 ? ", …" : ""));
  std::vector<RecordLine> lines;
  for (const auto& [number, line] : cases) lines.push_back(line);
  write_records(options.out, lines);
  fmt::print("{} records of {} folders in {}\n", lines.size(), options.folders.size(),
             options.out.string());
  return 0;
}

}  // namespace airybench
