#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/report/track.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/folder_lock.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

constexpr const char* track_footer = R"(
Every other option is one of a run ({bench} --help). Without them the nightly selection is measured:
  --mesh=Mesh0..Mesh2 --repetitions=9
  --method=3STEPD,3STEPD:CHOLMOD,BLIND:SCHUR,HYBRID,P2,ALM:r=20,rho=20,SDTIC6,3STEPCG6

Judged are  status, counters   any worsening against the last night of the same machine
            errors             growth by more than 1 % and by more than 1e-11
            times              changes of level over the nights of the same machine, reported once,
                               with the first night of the new level

Exit status  0  nothing is worse
             1  something is
             2  wrong usage, or a file that cannot be used or written: one line on standard error

Examples
  {bench} track --history=results/history
  {bench} track --history=results/history --from=results/latest
)";

constexpr std::array refused = {"--out", "--append", "--study", "--help", "--dry-run"};

struct TrackOptions {
  fs::path history = "results/history";
  fs::path from;  // empty: measure
  bool judge_only = false;
  double minimum_effect_percent = 5;
  TimeRules rules;
  std::vector<std::string> run;  // arguments of the run
};

bool is_option(const std::string& argument, const std::string& name) {
  return argument == name || argument.starts_with(name + "=");
}

TrackOptions parse_track(int argc, const char* const* argv) {
  TrackOptions options;
  CLI::App app("Measures a nightly selection, adds it to a history, and reports what has changed.",
               "{bench} track");
  app.footer(track_footer);
  app.allow_extras();
  app.add_option("--history", options.history, "folder of the history")->capture_default_str();
  auto* from = app.add_option("--from", options.from,
                              "add the records of this results folder instead of running");
  app.add_flag("--judge-only", options.judge_only, "judge the newest night again")->excludes(from);
  add_number(app, "--minimum-effect", Least::zero, 1000, options.minimum_effect_percent,
             "smallest change of a time that counts, in per cent");
  add_whole(app, "--nights-after", 2, 30, options.rules.min_after,
            "nights after a change of a time that confirm it");
  const char* const* const end = argv + argc;
  const char* const* const separator = std::find_if(
      argv, end, [](const char* argument) { return std::strcmp(argument, "--") == 0; });
  parse_command_line(app, static_cast<int>(separator - argv), argv);
  options.rules.minimum_effect = options.minimum_effect_percent / 100;
  options.run = app.remaining();
  for (const std::string& argument : options.run)
    for (const char* name : refused)
      if (is_option(argument, name))
        throw UsageError(fmt::format("{}: not with bench track (its runs go to {})", name,
                                     (options.history / "latest").string()));
  options.run.insert(options.run.end(), separator, end);
  if ((options.judge_only || !options.from.empty()) && !options.run.empty())
    throw UsageError(fmt::format("{}: not with {}, which does not run", options.run.front(),
                                 options.judge_only ? "--judge-only" : "--from"));
  return options;
}

TrackedRun run_in(const fs::path& folder) {
  const fs::path records = records_file_in(folder);
  return tracked_run_of(read_records(records), records.string());
}

TrackedRun measure(const TrackOptions& options) {
  const fs::path latest = options.history / "latest";
  const std::vector<std::string> arguments = nightly_arguments(options.run, latest.string());
  std::vector<const char*> argv = {"bench"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  run_command(static_cast<int>(argv.size()), argv.data());  // failed cases are findings
  return run_in(latest);
}

int track_and_print(std::vector<TrackedRun>& history, const TrackOptions& options) {
  track_newest(history, options.rules);
  const TrackedRun& run = history.back();
  write_tracked_run(run);
  const auto of_machine = std::ranges::count(history, run.machine(), &TrackedRun::machine);
  fmt::print("{}: {} cases, night {} of this machine ({})\n", run.file.string(), run.cases.size(),
             of_machine, run.machine());
  if (!run.times_judged)
    fmt::print("times are judged from night {} on\n", options.rules.min_runs());
  for (const Kind kind : {Kind::worse, Kind::better, Kind::changed})
    for (const Finding& finding : run.findings)
      if (finding.kind == kind) fmt::print("{:<7}  {}\n", name_of(kind), finding.sentence);
  fmt::print("{}\n", run.failed ? "failed: something is worse" : "nothing is worse");
  return run.failed ? some_case_failed : all_ok;
}

}  // namespace

std::vector<std::string> nightly_arguments(const std::vector<std::string>& own,
                                           const std::string& out) {
  const auto has = [&](const char* name) {
    return std::any_of(own.begin(), own.end(),
                       [&](const std::string& argument) { return is_option(argument, name); });
  };
  std::vector<std::string> arguments = {"--out=" + out};
  const bool has_own_cases = has("--figure") || has("--problem");
  if (!has("--mesh") && !has_own_cases) arguments.emplace_back("--mesh=Mesh0..Mesh2");
  if (!has("--method") && !has_own_cases)
    arguments.emplace_back(
        "--method=3STEPD,3STEPD:CHOLMOD,BLIND:SCHUR,HYBRID,P2,ALM:r=20,rho=20,SDTIC6,3STEPCG6");
  if (!has("--repetitions")) arguments.emplace_back("--repetitions=9");
  if (!has("--interleave")) arguments.emplace_back("--interleave");
  arguments.insert(arguments.end(), own.begin(), own.end());
  return arguments;
}

int track_command(int argc, const char* const* argv) {
  const TrackOptions options = parse_track(argc, argv);
  if (options.judge_only && read_history(options.history).empty())
    throw UsageError(fmt::format("{}: no nights (bench track without --judge-only adds one)",
                                 options.history.string()));
  std::optional<TrackedRun> run;
  if (!options.from.empty()) run = run_in(options.from);
  make_folder(options.history);
  const FolderLock lock(options.history);
  make_folder(options.history / "nights");
  check_can_write(options.history / "nights/new");
  std::vector<TrackedRun> history = read_history(options.history);  // before hours of measuring
  if (options.judge_only) return track_and_print(history, options);
  if (!run) run = measure(options);
  run->file = file_for(*run, options.history, history);
  // --from may add an older run: compare it with the runs before it only.
  std::erase_if(history, [&](const TrackedRun& other) { return other.date > run->date; });
  history.push_back(std::move(*run));
  return track_and_print(history, options);
}

}  // namespace airybench
