#include <fmt/format.h>

#include <iostream>

#include "bench/check/program_check.hpp"
#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/external/external_method.hpp"
#include "bench/measure/environment.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "support/errors.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* check_footer = R"(
The cases are those of {bench} --study=check, and one without a solution (docs/your-program.md).

Exit status  0  every case passes
             1  some case does not
             2  wrong usage, or a file that cannot be used: one line on standard error

Example
  {bench} new-external mine; {bench} check mine.json
)";

Options parse_check(int argc, const char* const* argv, std::filesystem::path& declaration) {
  Options options;
  options.limits.repetitions = 1;
  CLI::App app(
      "Runs another program on small cases that each find one mistake, and names the mistake "
      "that its answers look like.",
      "{bench} check");
  app.footer(check_footer);
  app.add_option("DECLARATION", declaration, "JSON file that declares the program")->required();
  add_number(app, "--target-error", Least::above_zero, max_limit, options.run.cases.target_error,
             "largest error of an answer that passes");
  add_whole(app, "--threads", 1, max_threads, options.run.cases.threads,
            "of BLAS, and {threads} of the program");
  add_number(app, "--timeout", Least::above_zero, max_limit, options.limits.timeout_s,
             "limit of one solve in seconds");
  add_memory_limit(app, options.limits);
  parse_command_line(app, argc, argv);
  options.run.study = study_named("check").value();
  for (const auto& [option, value] : options.run.study.options)
    if (option == "--mesh") options.run.meshes = value;
  return options;
}

}  // namespace

int check_command(int argc, const char* const* argv) {
  std::filesystem::path declaration;
  const Options options = parse_check(argc, argv, declaration);
  require_standard_output();
  const Method program = external_method(for_every_value(read_declaration(declaration)).front(),
                                         options.limits.memory_limit_bytes);
  require_threads(options.run.cases.threads);
  const std::vector<PosedScene> scenes = posed_scenes(options);
  set_threads(options.run.cases.threads);
  catch_interrupts();
  const std::size_t all = scenes.size() + 1;
  std::size_t number = 0;
  const CheckReport report = check_program(
      program, scenes, common_settings(options.run), options.limits, [&](const CheckedCase& seen) {
        std::cerr << fmt::format("[{}/{}] {}: {}\n", ++number, all, seen.name, seen.verdict)
                  << std::flush;
      });
  std::vector<std::vector<std::string>> rows = {{"case", "made for", "verdict", "looks like"}};
  std::size_t passed = 0;
  for (const CheckedCase& seen : report.cases) {
    rows.push_back({seen.name, seen.made_for, seen.verdict, seen.passed ? "-" : seen.looks_like});
    if (seen.passed) ++passed;
  }
  fmt::print("\n{}\n{}: {} of {} cases passed\n", aligned_table(rows, rows.front().size()),
             program.name, passed, all);
  if (passed == all) return all_ok;
  if (!report.conclusion.empty()) fmt::print("all its answers look like: {}\n", report.conclusion);
  return some_case_failed;
}

}  // namespace airybench
