#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "bench/commands/command_line.hpp"
#include "bench/commands/planned_cases.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/measure/environment.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/results_table.hpp"
#include "bench/run/noise_watch.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "support/atomic_file.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

void print_warnings(const std::vector<std::string>& of_machine, const EarlyPasses& early,
                    std::size_t cases) {
  for (const std::string& warning : of_machine) fmt::print("note: {}\n", warning);
  if (early.count() > 0)
    fmt::print(
        "note: {} of {} cases passed as quiet before the machine became quieter than it had been\n",
        early.count(), cases);
}

std::string times_line(const RunTimes& times) {
  const auto percent = [&](double part) { return 100 * part / times.wall_s; };
  return fmt::format(
      "{}: {:.1f} % in solves, {:.1f} % assembly and references, {:.1f} % judging, {:.1f} % "
      "harness",
      show_duration(times.wall_s), percent(times.runs_s), percent(times.preparation_s),
      percent(times.judging_s), percent(times.harness_s()));
}

}  // namespace

int run_command(int argc, const char* const* argv) {
  const Options options = parse_options(argc, argv);
  ResultsTable table(options.output.columns);
  if (options.dry_run) {
    require_standard_output();
    print_forecast(planned_cases(options).part, options);
    return all_ok;
  }
  require_threads(options.run.cases.threads);
  check_takes_records(options.output.folder);  // before meshes are written there
  if (!options.run.adapt.goals.empty())
    catch_interrupts();  // adapting solves; a signal just ends other planning
  const PlannedCases planned = planned_cases(options);
  for (const std::string& why : planned.short_of) std::cerr << fmt::format("note: {}\n", why);
  if (planned.whole.empty()) return some_case_failed;
  const std::vector<Case>& plan = planned.part;
  set_threads(options.run.cases.threads);
  catch_interrupts();
  if (const auto records = options.output.folder / "records.jsonl";
      !options.output.append && !options.output.resume && std::filesystem::exists(records))
    std::cerr << fmt::format("note: {}: this run replaces its records (--append keeps them)\n",
                             options.output.folder.string());
  Context context = context_of_run(options);
  context["cases_planned"] = std::to_string(planned.whole.size());
  context["plan_sha256"] = fingerprint(planned.whole);
  const RunResult result = run_cases(plan, options.limits, options.output, context);
  EarlyPasses early;
  std::vector<double> noise;
  std::vector<Record> beyond_goal;
  bool all_solved = planned.short_of.empty();
  const std::size_t cases = result.names.size();
  for (std::size_t k = 0; k < cases; ++k) {
    const Record record = result.record(k);
    table.add(record);
    early.add(record);
    std::ranges::copy(record.noise_kernel_samples_s, std::back_inserter(noise));
    all_solved = all_solved && (record.status == Status::ok || record.status == Status::skipped);
    if (misses_goal(record)) beyond_goal.push_back(record);
  }
  fmt::print("\n{}\n", table.text());
  for (const Record& r : beyond_goal)
    fmt::print("note: {}: its total error, {:.3g} %, is above the goal of {:g} %\n",
               name_of(r).text(), 100 * *r.error_total, 100 * *r.adapt_goal);
  if (result.earlier > 0)
    fmt::print("{} of these {} records were there already{}\n", result.earlier, cases,
               result.files->was_torn() ? ", and the start of another, which was run again" : "");
  if (result.earlier < std::ssize(plan)) fmt::print("{}\n", times_line(result.times));
  print_warnings(machine_warnings(context, min_repetitions(options.limits), noise), early, cases);
  fmt::print("records.jsonl, results.csv, results.json in {}\n", options.output.folder.string());
  end_run(result, options.output.folder, options.run.cases.fields);
  if (cases != plan.size())
    throw std::logic_error(
        fmt::format("{} of {} cases have no record", plan.size() - cases, plan.size()));
  return all_solved && beyond_goal.empty() ? all_ok : some_case_failed;
}

}  // namespace airybench
