#include "bench/records/merge_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "bench/command_line.hpp"
#include "bench/options.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record_files.hpp"

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

struct Placed {
  std::string place;  // "part1/records.jsonl:3"
  Json record;
};

std::vector<Placed> read_all(const std::vector<std::filesystem::path>& folders) {
  std::vector<Placed> all;
  for (const auto& folder : folders) {
    int line = 0;
    for (auto& record : read_record_lines(folder))
      all.push_back(
          {fmt::format("{}:{}", (folder / "records.jsonl").string(), ++line), std::move(record)});
  }
  if (all.empty()) throw OutputError("the folders have no records");
  return all;
}

void refuse_mixtures(const std::vector<Placed>& all) {
  const Context first = context_of(all.front().record);
  for (const Placed& other : all) {
    const std::string differs =
        differences(first, context_of(other.record), Sameness::same_sources);
    if (!differs.empty())
      throw OutputError(
          fmt::format("{} and {} do not mix: {}", all.front().place, other.place, differs));
  }
}

// By the case's number in the plan.
std::map<int, const Placed*> by_number(const std::vector<Placed>& all) {
  std::map<int, const Placed*> cases;
  for (const Placed& placed : all) {
    const int number = placed.record.value("case_number", 0);
    if (number < 1)
      throw OutputError(
          fmt::format("{}: case_number: {} (allowed: from 1; records of before there "
                      "were shards do not join)",
                      placed.place, number));
    const auto [there, is_new] = cases.emplace(number, &placed);
    if (!is_new)
      throw OutputError(fmt::format("{} and {}: both are case {}, {}", there->second->place,
                                    placed.place, number, case_name(placed.record)));
  }
  return cases;
}

}  // namespace

int merge_command(int argc, const char* const* argv) {
  const MergeOptions options = parse_merge(argc, argv);
  const std::vector<Placed> all = read_all(options.folders);
  refuse_mixtures(all);
  const std::map<int, const Placed*> cases = by_number(all);
  // The same in all, or they would have been refused.
  const int plan = std::atoi(context_of(all.front().record)["cases_planned"].c_str());
  std::string missing;
  int count = 0;
  for (int number = 1; number <= plan; ++number)
    if (cases.count(number) == 0 && ++count <= 10)
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", number);
  if (count > 0 && !options.incomplete)
    throw OutputError(
        fmt::format("{} of {} cases are missing: {}{} (go on with the shard by "
                    "--resume, or take --incomplete)",
                    count, plan, missing, count > 10 ? ", …" : ""));
  std::vector<Json> records;
  for (const auto& [number, placed] : cases) records.push_back(placed->record);
  write_records(options.out, records);
  fmt::print("{} records of {} folders in {}\n", records.size(), options.folders.size(),
             options.out.string());
  return 0;
}

}  // namespace airybench
