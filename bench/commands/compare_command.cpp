#include "bench/commands/compare_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/tracking/compare_report.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr const char* compare_footer = R"(
Verdicts  faster, slower    p (Mann-Whitney, adjusted by Holm over the cases) is at most 5 %, and the
                            effect is above the minimum one and above the drift of the machine
          not separated     chance or drift can be the reason
          too few samples   no p could be small enough; how many repetitions would do is said below

Exit status  0  no regression
             1  a case is slower, or was ok and is not any more
             2  wrong usage, or records that cannot be read: one line on standard error

Example
  bench compare results/before results/after --out=comparison.md
)";

struct CompareOptions {
  std::filesystem::path a, b, out;
  double minimum_effect_percent = 3;
};

CompareOptions parse_compare(int argc, const char* const* argv) {
  CompareOptions options;
  CLI::App app("Two runs of the same cases: which have become slower or faster.", "bench compare");
  app.footer(compare_footer);
  app.add_option("A", options.a, "folder with records.jsonl, before")->required();
  app.add_option("B", options.b, "folder with records.jsonl, after")->required();
  app.add_option("--minimum-effect", options.minimum_effect_percent,
                 "per cent: smaller changes of a time are no change")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("--out", options.out, "also write the comparison to this file, *.md or *.json");
  parse_command_line(app, argc, argv);
  const std::filesystem::path extension = options.out.extension();
  if (!options.out.empty() && extension != ".md" && extension != ".json")
    throw UsageError(
        fmt::format("--out: {} (allowed: a name that ends in .md or .json)", options.out.string()));
  return options;
}

std::vector<Record> records_of(const std::filesystem::path& folder) {
  return read_records(folder / "records.jsonl", Studies::include);
}

}  // namespace

int compare_command(int argc, const char* const* argv) {
  const CompareOptions options = parse_compare(argc, argv);
  CompareRules rules;
  rules.minimum_effect = options.minimum_effect_percent / 100;
  const Comparison comparison = compare(records_of(options.a), records_of(options.b), rules);
  if (comparison.cases.empty())
    throw UsageError(
        fmt::format("{} and {}: no case is in both", options.a.string(), options.b.string()));
  const std::string title = fmt::format("A: {}, B: {}", options.a.string(), options.b.string());
  if (options.out.extension() == ".md") {
    std::string text = title;
    text += "\n\n";
    text += comparison_markdown(comparison);
    write_file_atomically(options.out, text);
  }
  if (options.out.extension() == ".json")
    write_file_atomically(options.out, indented_json_text(comparison_json(comparison), 1) + "\n");
  fmt::print("{}\n\n{}", title, comparison_text(comparison));
  return comparison.has_regression() ? 1 : 0;
}

}  // namespace airybench
