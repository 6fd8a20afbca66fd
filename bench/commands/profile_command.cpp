#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/part_solution.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/measure/environment.hpp"
#include "bench/records/robust.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "bench/run/adaptive_loop.hpp"
#include "solvers/methods.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* profile_footer = R"(
Runs the adaptive loop several times in one process and prints medians by level and phase. "first" is the first
run, which also sets up memory and tables, as every loop of `bench --adapt` does.

Exit status  0  the loop ended
             1  it had no level
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  {bench} profile Mesh0 --error=0.1%
  {bench} profile part.geo load.json --error=1% --degree=3
)";

Options parse_profile(int argc, const char* const* argv) {
  Options options = options_of_part();
  options.output.folder = "results/profile";
  options.limits.repetitions = 9;
  std::string error = "0.1%", degree = "auto";
  CLI::App app("Where the time of the adaptive loop goes.", "{bench} profile");
  app.footer(profile_footer);
  add_part(app, options.run);
  app.add_option("--error", error, "total error, relative")->capture_default_str();
  app.add_option("--degree", degree, "degree of the stresses: 1 to 4, auto")->capture_default_str();
  add_whole(app, "--repetitions", 1, 1000, options.limits.repetitions, "runs of the loop");
  app.add_option("--out", options.output.folder, "folder of converted models")
      ->capture_default_str();
  parse_command_line(app, argc, argv);
  const std::optional<AdaptGoal> goal = adapt_goal_of(error);
  if (!goal || !goal->error)
    throw UsageError(
        fmt::format("--error: {} (allowed: above 0% and below 100%)", shortened(error)));
  ask_for({*goal->error, PartQuantity::force}, degree, options);
  return options;
}

std::int64_t page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

struct ProfiledRun {
  std::vector<int> unknowns;  // by level
  std::vector<LevelTimes> levels;
  double time_s = 0;
  std::int64_t page_faults = 0;
};

ProfiledRun profiled_run(const Scene& scene, const Mesh& mesh, const Options& options) {
  const std::int64_t before = page_faults();
  AdaptiveLoop loop(scene, mesh, adapting_method(options.run.adapt.by),
                    {.goals = options.run.adapt.goals});
  ProfiledRun run;
  while (const auto level = loop.next()) {
    run.unknowns.push_back(level->unknowns);
    run.levels.push_back(level->times);
    run.time_s = level->time_s;
  }
  run.page_faults = page_faults() - before;
  return run;
}

// Seconds of each phase, of the solve by stage.
std::vector<std::pair<std::string, double>> phases_of(const LevelTimes& times) {
  double staged_s = 0;
  std::vector<std::pair<std::string, double>> phases = {{"refine", times.refine_s},
                                                        {"pose", times.pose_s}};
  for (const Stage stage : all_stages) {
    const double seconds = times.stages[stage].value_or(0);
    staged_s += seconds;
    if (stage != Stage::precondition) phases.emplace_back(name_of(stage), seconds);
  }
  phases.emplace_back("rest of the solve", times.solve_s - staged_s);
  phases.emplace_back("estimate", times.estimate_s);
  return phases;
}

void print_profile(const std::vector<ProfiledRun>& runs) {
  std::vector<std::vector<std::string>> table = {{"phase"}};
  for (const int unknowns : runs.front().unknowns)
    table.front().push_back(fmt::format("n_phi {}", unknowns));
  std::ranges::copy(std::vector<std::string>{"all", "share", "first", ""},
                    std::back_inserter(table.front()));
  const auto over_runs = [&](const auto& of_run) {
    std::vector<double> values;
    for (const ProfiledRun& run : runs)
      values.push_back(static_cast<double>(std::invoke(of_run, run)));
    return median(std::move(values));
  };
  const auto of_all = [](const ProfiledRun& run, std::size_t phase) {
    double sum_s = 0;
    for (const LevelTimes& level : run.levels) sum_s += phases_of(level)[phase].second;
    return sum_s;
  };
  const double whole_s = over_runs(&ProfiledRun::time_s);
  const auto phases = phases_of(runs.front().levels.front());
  for (std::size_t phase = 0; phase < phases.size(); ++phase) {
    std::vector<std::string>& row = table.emplace_back();
    row.push_back(phases[phase].first);
    for (std::size_t level = 0; level < runs.front().levels.size(); ++level)
      row.push_back(show_seconds(over_runs(
          [&](const ProfiledRun& run) { return phases_of(run.levels[level])[phase].second; })));
    const double all_s = over_runs([&](const ProfiledRun& run) { return of_all(run, phase); });
    row.push_back(show_seconds(all_s));
    row.push_back(fmt::format("{:.1f} %", 100 * all_s / whole_s));
    row.push_back(show_seconds(of_all(runs.front(), phase)));
    row.emplace_back();
  }
  fmt::print("{}\n", aligned_table(table, 1));
  const double last_s = over_runs([](const ProfiledRun& run) { return run.levels.back().solve_s; });
  fmt::print("all levels: {}, {:.1f} times the last level's solve ({}); first run {}\n",
             show_seconds(whole_s), whole_s / last_s, show_seconds(last_s),
             show_seconds(runs.front().time_s));
  fmt::print("page faults: {:.0f}; first run {}\n", over_runs(&ProfiledRun::page_faults),
             runs.front().page_faults);
}

}  // namespace

int profile_command(int argc, const char* const* argv) {
  const Options options = parse_profile(argc, argv);
  require_standard_output();
  catch_interrupts();
  const PosedScene start = one_posed_scene(options);
  set_threads(1);
  const Mesh& mesh = start.body()->mesh;
  const Scene scene = scene_of_level_0(start).scene;
  std::vector<ProfiledRun> runs;
  for (int run = 0; run < options.limits.repetitions; ++run) {
    throw_if_interrupted();
    runs.push_back(profiled_run(scene, mesh, options));
    if (runs.back().levels.empty()) return some_case_failed;
  }
  print_profile(runs);
  return all_ok;
}

}  // namespace airybench
