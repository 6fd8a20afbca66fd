#include "bench/commands/check_command.hpp"

#include <fmt/format.h>

#include <iostream>

#include "bench/check/check.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/external/external_method.hpp"
#include "bench/external/new_external.hpp"
#include "bench/measure/environment.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {

int check_external(Options options) {
  require_standard_output();
  options.limits.repetitions = 1;
  const Method program = external_method(for_every_value(read_declaration(options.check)).front(),
                                         options.limits.memory_limit_bytes);
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

int new_external(const std::filesystem::path& name) {
  const auto files = write_new_external(name);
  const std::string declaration = shell_word(files.back().string());
  const std::string bench = called_as("bench");
  fmt::print(
      "{} and {} written: a program that is right as it is. Change its contact_forces(), then:\n"
      "  {} --check={}    (small cases that each find one mistake)\n"
      "  {} --study=check --method='HYBRID,EXTERNAL:*' --external={}    (its time, next to ours)\n"
      "Do not test with the default scene of Mesh0 to Mesh7: G is zero but for rounding there, so\n"
      "that a wrong sign of it passes.\n",
      files.front().string(), files.back().string(), bench, declaration, bench, declaration);
  return all_ok;
}

}  // namespace airybench
