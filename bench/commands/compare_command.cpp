#include "bench/commands/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/records/context.hpp"
#include "bench/report/compare.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* compare_footer = R"(
Verdicts  faster, slower    p (Mann-Whitney of the runs' medians, adjusted by Holm over the cases) is
                            at most 5 %, the effect is above the minimum one and above the drift of the
                            machine, and the runs were interleaved
          not separated     chance, drift or the time of day can be the reason, or there are too few
                            runs: how many would do is printed below
Repetitions within a run are not independent: the unit is the run. So run A and B in turn, each time
into a separate folder. With one run each only statuses can fail.

Exit status  0  no regression
             1  a case is slower, or was ok in all runs of A and is not in one of B
             2  wrong usage, or records that cannot be read: one line on standard error

Examples
  {run} compare HEAD~1 HEAD --mesh=Mesh3 --method=HYBRID   # builds and runs both, in turn
  for i in 1 2 3 4 5 6; do old/bench/bench --out=a$i; build/release/bench/bench --out=b$i; done
  {bench} compare a1,a2,a3,a4,a5,a6 b1,b2,b3,b4,b5,b6 --out=comparison.md
  {bench} compare results/before results/after
)";

// Throws FileError if the runs differ in program or settings, or if one is repeated.
Runs runs_in(const std::string& folders) {
  Runs runs;
  const std::vector<std::string> names = split_list(folders);
  for (const std::string& name : names) {
    const std::filesystem::path file = records_file_in(name);
    runs.push_back(read_records(file, Studies::include));
    if (runs.back().empty() || runs.front().empty()) continue;
    const Context &first = runs.front().front().context, &context = runs.back().front().context;
    const std::string differs = differences(first, context, Sameness::same_sources);
    if (!differs.empty())
      throw FileError(fmt::format("{}: another program or other settings than of {}: {}",
                                  file.string(), names.front(), differs));
    for (std::size_t i = 0; i + 1 < runs.size(); ++i)
      if (!runs[i].empty() && runs[i].front().samples_s == runs.back().front().samples_s &&
          runs[i].front().context == context)
        throw FileError(fmt::format("{}: the same run as {}", file.string(), names[i]));
  }
  return runs;
}

// The first ones' names, and how many there are more.
std::string cases_of(const Runs& runs) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const std::vector<Record>& run : runs)
    for (const Record& record : run)
      if (std::string name = name_of(record).text(); std::ranges::find(names, name) == names.end())
        names.push_back(std::move(name));
  if (names.empty()) return "no cases";
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace

int compare_command(int argc, const char* const* argv) {
  std::string a, b, names;
  std::filesystem::path out;
  double minimum_effect_percent = 3;
  CLI::App app("Compares runs of two programs, case by case: faster, slower or not separated.",
               "{bench} compare");
  app.footer(compare_footer);
  app.add_option("A", a,
                 "folders with records.jsonl of the first program, a run each: DIR[,DIR...]")
      ->required();
  app.add_option("B", b, "folders of the second program")->required();
  add_number(app, "--minimum-effect", Least::zero, 1000, minimum_effect_percent,
             "smallest change of a time that counts, in per cent");
  app.add_option("--names", names, "A,B: names of the programs for the first line");
  app.add_option("--out", out, "also write the comparison to this file, *.md or *.json");
  parse_command_line(app, argc, argv);
  if (out.empty()) require_standard_output();
  if (!out.empty() && out.extension() != ".md" && out.extension() != ".json")
    throw UsageError(
        fmt::format("--out: {} (allowed: a name that ends in .md or .json)", out.string()));

  const std::vector<std::string> called =
      names.empty() ? std::vector<std::string>() : split_list(names);
  if (!called.empty() && called.size() != 2)
    throw UsageError(fmt::format("--names: {} (allowed: two names)", shortened(names)));

  CompareRules rules;
  rules.minimum_effect = minimum_effect_percent / 100;
  const Runs before = runs_in(a), after = runs_in(b);
  const Comparison comparison = compare(before, after, rules);
  if (comparison.cases.empty())
    throw UsageError(fmt::format("{} and {}: no case is in both ({}; {})", a, b, cases_of(before),
                                 cases_of(after)));
  const std::string title =
      fmt::format("A: {} ({} runs), B: {} ({} runs)", called.empty() ? a : called.front(),
                  before.size(), called.empty() ? b : called.back(), after.size());
  if (out.extension() == ".md") write_file_atomically(out, title + "\n\n" + comparison.markdown());
  if (out.extension() == ".json")
    write_file_atomically(out, indented_json_text(comparison.json(), 1) + "\n");
  fmt::print("{}\n\n{}", title, comparison.text());
  return comparison.has_regression() ? 1 : 0;
}

}  // namespace airybench
