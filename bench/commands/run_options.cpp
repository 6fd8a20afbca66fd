#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/former_options.hpp"
#include "bench/measure/build_info.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "mesh/model_format.hpp"
#include "solvers/methods.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr const char* run_footer = R"(
Everything after "--" goes to Google Benchmark.

Exit status  0  every case is ok, or skipped with a reason
             1  some case is not, or a mesh could not be adapted as far as --adapt asks
             2  wrong usage, or a file that cannot be used or written: one line on standard error
             3  out of memory, or a defect of bench itself: one line on standard error (so with every
                command)
         128+n  ended by signal n (Ctrl-C: 130); what was measured is in the folder

Examples
  {bench} --mesh=Mesh0..Mesh7 --method='3STEPD*'
  {bench} --figure=3 --out=results/figure3
  {bench} --study=error --mesh=Mesh0..Mesh3 --out=results/error
  {bench} --study=stability --out=results/stability
  {bench} --study=adapted --out=results/adapted
  {bench} --mesh=Mesh0,Mesh4 --method=HYBRID,P2 --adapt=0.3% --out=results/adapted
  {bench} --mesh=Mesh0..Mesh7 --out=results/long --resume
  {bench} --mesh=Mesh0..Mesh7 --shard=2/4 --out=results/part2
  {bench} --mesh=part.geo --role=clamped=displacement --mesh-size=50%
  {bench} --mesh=Mesh3,part.msh --scene=flat.json --repetitions=11 --out=results/flat
)";

constexpr const char* explain_footer = R"(
Options are those of a run; --dry-run adds a forecast of time and memory.

Examples
  {bench} explain --mesh=Mesh0
  {bench} explain --mesh=part.geo --scene=load.json --method='*'
)";

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& allowed) {
  throw UsageError(fmt::format("{}: {} (allowed: {})", option, shortened(text), allowed));
}

std::string footer() {
  std::string text = "\nStudies\n";
  for (const Study& study : all_studies())
    text += fmt::format("  {:<10}  {}\n", study.name, study.about);
  return text + "\n" + list_of_commands() + run_footer;
}

// Option values that are parsed after CLI11.
struct Texts {
  std::string study, stop = "target", contact = "newton", repetitions = "5", noise, threads = "1",
                     timeout = "900", adapt, degree, shard, columns, fields;
};

void add_cases(CLI::App& app, Options& options, Texts& texts) {
  app.option_defaults()->group("What is solved");
  app.add_option("--mesh", options.run.meshes,
                 "range, list (Mesh0,Mesh3), glob, or files, meshes and models: " +
                     std::string(model_extensions))
      ->capture_default_str();
  add_model_settings(app, options.run.model_settings);
  add_files(app, "--scene", options.run.scenes,
            "scene files or globs; default: the documented tooth or rack");
  add_files(app, "--problem", options.run.problems,
            "instead of meshes and scenes: contact problems, files (FCLIB, Siconos' .dat), folders "
            "or globs, by every contact solver (CONDENSED: newton) or --contact");
  app.add_option(
      "--adapt", texts.adapt,
      "GOALS[,levels=last][,by=METHOD][,marking=SHARE]: refine where the error is, until "
      "1% or 50000 unknowns; several goals in turn (docs/adaptive-meshes.md)");
  app.option_defaults()->group("By which methods");
  app.add_option(
      "--degree", texts.degree,
      fmt::format("degree of HYBRID's stresses on the levels of --adapt and in cases: 1 to {}, or "
                  "auto (3 for goals below 0.1%, else 2)",
                  highest_degree));
  app.add_option(
      "--method", options.run.methods,
      "names or globs; default: the paper's, for your own bodies HYBRID and P2, next to other "
      "programs HYBRID");
  add_files(app, "--external", options.run.externals,
            "declarations of other programs, files or globs: methods EXTERNAL:name "
            "(docs/your-program.md)");
  app.add_option(
         "--contact", texts.contact,
         "solver of the condensed contact problem (docs/methods.md); gauss-seidel is the paper's")
      ->check(CLI::IsMember(names_of(all_contact_solvers)))
      ->capture_default_str();
  add_whole(app, "--figure", 3, 5, options.run.figure,
            "3: every preconditioner of SYMMLQ and 3STEPCG on Mesh3; 4, 5: the paper's methods, "
            "Mesh0..Mesh7")
      ->excludes(app.get_option("--mesh"))
      ->excludes(app.get_option("--method"));
  app.add_option(
         "--study", texts.study,
         "a study listed below; error:0.01,0.1 also finds the least error within these seconds")
      ->excludes(app.get_option("--figure"));
}

void add_measuring(CLI::App& app, Options& options, Texts& texts) {
  app.option_defaults()->group("How it is measured");
  add_number(app, "--target-error", Least::above_zero, max_limit, options.run.cases.target_error,
             "iterative methods are tightened until their own estimate is below this; a case with "
             "larger errors is inaccurate");
  app.add_option("--stop", texts.stop,
                 "when iterative methods stop: at the target error, or as the paper's do, whatever "
                 "error they leave")
      ->check(CLI::IsMember({"target", "paper"}))
      ->capture_default_str();
  app.add_option(
         "--repetitions", texts.repetitions,
         "MIN[..MAX][,precision=2%][,within=30]: timed runs of each case, until its median is "
         "known to 2 % or the runs have taken 30 s (docs/measuring.md)")
      ->capture_default_str();
  app.add_flag("--retry-noisy", texts.noise,
               "measure a case again, up to three times, if the calibration loop around it was off "
               "by more than 5 % (--retry-noisy=7%: 7 %)");
  app.add_flag("--interleave", options.limits.interleave,
               "repeat the cases of a scene in random order; write its records at its end");
  app.add_option(
         "--threads", texts.threads,
         "threads of BLAS and for right-hand sides; with --study=scaling a list (default: 1, 2, "
         "4, ... up to the processors)")
      ->capture_default_str();
  app.add_option(
         "--timeout", texts.timeout,
         "SECONDS[,tuning=SECONDS][,others=SECONDS]: limits of one solve, of a case's search for "
         "parameters and tolerances, and of any other phase, such as assembly, reference or "
         "errors (default: as a solve, but at least 900)")
      ->capture_default_str();
  add_memory_limit(app, options.limits);
}

void add_output(CLI::App& app, Options& options, Texts& texts) {
  app.option_defaults()->group("What is kept");
  app.add_option("--out", options.output.folder, "folder of the output files")
      ->capture_default_str();
  app.add_option("--columns", texts.columns,
                 "columns of the printed table: all, or names; default: eight");
  app.add_flag("--append", options.output.append,
               "keep the records in the folder, except those of the cases run");
  app.add_flag(
         "--resume", options.output.resume,
         "continue the run in the folder, with the same machine, program and options: run only "
         "the cases without a record")
      ->excludes(app.get_option("--append"));
  app.add_option(
      "--shard", texts.shard,
      "k/n: the k-th of n parts of the cases, for n machines ({bench} merge joins them)");
  app.add_flag("--fields", texts.fields,
               "stresses, displacements, contact points (*.csv, *.vtu), total errors; =mean: the "
               "mean with admissible stresses, too; =histories: of iterations, too");
  app.option_defaults()->group("Instead of a run");
  app.add_flag(
      "--dry-run", options.dry_run,
      "print the cases, a forecast of time and memory (from earlier records) and what is left "
      "out; with --adapt for the first level");
}

double share_of(const std::string& option, const std::string& text, const std::string& example) {
  const std::optional<double> share = parse_percent(text);
  if (!share) refuse(option, text, "above 0% and below 100%, " + example);
  return *share;
}

void read_study(const std::string& text, RunSettings& run) {
  if (text.empty()) return;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::optional<Study> study = study_named(text.substr(0, colon));
  if (!study) {
    std::vector<std::string> names;
    for (const Study& known : all_studies()) names.push_back(known.name);
    refuse("--study", text, fmt::format("{}", fmt::join(names, ", ")));
  }
  run.study = *study;
  if (colon == text.size()) return;
  if (study->points != Study::Points::accuracy)
    refuse("--study", text, "seconds with error, which chooses from points");
  for (const std::string& word : split_list(text.substr(colon + 1)))
    run.budgets_s.push_back(
        read_number("--study=" + study->name, word, Least::above_zero, max_limit));
  std::ranges::sort(run.budgets_s);
}

void read_repetitions(const std::string& text, Limits& limits) {
  constexpr int most = 100000;
  const std::string option = "--repetitions";
  const ValueParts parts(option, text, {"precision", "within"});
  const std::string& range = parts.only_item();
  const std::size_t dots = std::min(range.find(".."), range.size());
  limits.repetitions = static_cast<int>(read_whole(option, range.substr(0, dots), 1, most));
  limits.long_case_s = parts.number("within", max_limit).value_or(limits.long_case_s);
  if (const auto share = parts.setting("precision"))
    limits.precision = share_of(option + ": precision", *share, "as 2%");
  if (dots < range.size()) {
    limits.max_repetitions = static_cast<int>(read_whole(option, range.substr(dots + 2), 1, most));
    if (!limits.precision)
      refuse(option, text, "a range with a precision, " + shortened(range) + ",precision=2%");
  }
  if (limits.precision && limits.max_repetitions < min_repetitions(limits))
    refuse(option, fmt::format("at most {}", limits.max_repetitions),
           fmt::format("from {} on", min_repetitions(limits)));
}

// With budgets, a run may take twice the largest one: a detail run takes longer than a timed run.
// No recorded time includes the search for parameters, so its limit stays.
void read_timeout(const std::string& text, bool is_given, const std::vector<double>& budgets_s,
                  Limits& limits) {
  const ValueParts parts("--timeout", text, {"tuning", "others"});
  limits.timeout_s = read_number("--timeout", parts.only_item(), Least::above_zero, max_limit);
  limits.tuning_budget_s = parts.number("tuning", max_limit);
  limits.others_s = parts.number("others", max_limit);
  if (budgets_s.empty() || is_given) return;
  if (!limits.tuning_budget_s) limits.tuning_budget_s = limits.timeout_s;
  limits.timeout_s = 2 * budgets_s.back();
}

void read_adapt(const std::string& text, Adaptation& adapt) {
  const ValueParts parts("--adapt", text, {"by", "levels", "marking"});
  const std::vector<std::string> none = {""};
  for (const std::string& item : parts.items.empty() ? none : parts.items) {
    const std::optional<AdaptGoal> goal = adapt_goal_of(item);
    if (!goal)
      refuse("--adapt", item,
             "a total error above 0% and below 100%, as 1%, or a number of unknowns from "
             "100 to 5000000");
    adapt.goals.push_back(*goal);
  }
  adapt.by = parts.setting("by").value_or(adapt.by);
  adapt.marking = parts.number("marking", 1);
  const std::string levels = parts.setting("levels").value_or("all");
  if (levels != "all" && levels != "last") refuse("--adapt", "levels=" + levels, "all, last");
  adapt.goals_only = levels == "last";
}

}  // namespace

void read_degree(const std::string& text, bool keeps_methods, RunSettings& run) {
  // On the default tooth degree 3 takes 1.5 of degree 2's time for 0.1 %, 0.75 of it for 0.03 %.
  constexpr double low_error = 0.001;
  int degree = 2;
  if (text == "auto") {
    for (const AdaptGoal& goal : run.adapt.goals)
      if (goal.error.value_or(1) < low_error) degree = 3;
  } else if (text.size() == 1 && text[0] >= '1' && text[0] - '0' <= highest_degree) {
    degree = text[0] - '0';
  } else {
    refuse("--degree", text, fmt::format("1 to {}, auto", highest_degree));
  }
  const std::string hybrid = hybrid_of_degree(degree);
  if (run.adapt.by != "HYBRID" && run.adapt.by != hybrid)
    refuse("--degree=" + text + " with --adapt=...,by", run.adapt.by,
           "one of both, or by=" + hybrid);
  run.degree = degree;
  run.adapt.by = hybrid;
  if (!keeps_methods) run.methods = hybrid;
}

namespace {

void read_fields(const std::string& text, CaseSettings& asked) {
  asked.fields = true;
  for (const std::string& word : split_list(text))
    if (word == "mean")
      asked.mean_fields = true;
    else if (word == "histories")
      asked.histories = true;
    else if (word != "true")
      refuse("--fields", word, "mean, histories, or no value");
}

// In the scaling study at most the number of processors: beyond it, efficiency means nothing.
void read_threads(const std::string& text, bool is_given, RunSettings& run) {
  const bool scaling = run.study.points == Study::Points::threads;
  const int processors = processors_at_hand();
  std::set<int> counts = {1};
  if (scaling && !is_given) {
    for (int count = 2; count < processors; count *= 2) counts.insert(count);
    counts.insert(processors);
  }
  const std::vector<std::string> words =
      scaling ? split_list(text) : std::vector<std::string>{text};
  for (const std::string& word : words) {
    const std::optional<std::int64_t> count = parse_whole(word);
    if (!count || *count < 1 || *count > (scaling ? processors : max_threads))
      refuse("--threads", text,
             scaling ? fmt::format("whole numbers from 1 to {}, the processors of this machine",
                                   processors)
                     : fmt::format("a whole number from 1 to {}; a list with --study=scaling",
                                   max_threads));
    counts.insert(static_cast<int>(*count));
    run.cases.threads = static_cast<int>(*count);
  }
  if (!scaling) return;
  run.thread_counts.assign(counts.begin(), counts.end());
  run.cases.threads = run.thread_counts.back();
}

void refuse_contradictions(const Options& options) {
  using enum Study::Points;
  const bool paper = options.run.cases.stop == Stop::paper;
  const Study& study = options.run.study;
  const std::string chosen = "not with --study=" + study.name;
  const std::pair<bool, std::string> rules[] = {
      {options.run.cases.contact && paper,
       "--contact: not with --stop=paper, whose contact law is gauss-seidel"},
      {options.run.cases.contact && study.points == contact,
       "--contact: " + chosen + ", which has all of them"},
      {paper && study.points == accuracy,
       "--stop=paper: " + chosen + ", which has the paper's stop as a point"},
      {paper && study.points == contact,
       "--stop=paper: " + chosen + ", whose solvers are not the paper's"},
      {options.limits.precision && study.once,
       "--repetitions: precision: " + chosen + ", which times each case once"},
      {options.limits.interleave && study.points == threads,
       "--interleave: " + chosen +
           ": BLAS's idle threads of one case are awake in another's time"}};
  for (const auto& [is_broken, message] : rules)
    if (is_broken) throw UsageError(message);
}

}  // namespace

Options parse_options(int argc, const char* const* argv, Asked asked) {
  Options options;
  Texts texts;
  const bool is_run = asked == Asked::run;
  CLI::App app(is_run ? "Time, memory and error of methods for stress-formulated contact with "
                        "friction, for every mesh, scene and method chosen."
                      : "The stages that each case of a run has, those left out and why. Nothing "
                        "is solved.",
               is_run ? "{bench}" : "{bench} explain");
  app.footer(is_run ? footer() : explain_footer);
  if (is_run) {
    app.set_help_all_flag("--help-all", "every option");
    app.formatter_fn([](const CLI::App* run, std::string name, CLI::AppFormatMode mode) {
      return mode == CLI::AppFormatMode::Normal ? overview()
                                                : CLI::Formatter().make_help(run, name, mode);
    });
  }
  app.set_version_flag("--version", std::string("airybench ") + build_info.version);
  add_cases(app, options, texts);
  add_measuring(app, options, texts);
  add_output(app, options, texts);
  const char* const* const end = argv + argc;
  const char* const* const separator = std::find(argv, end, std::string_view("--"));
  const int own = static_cast<int>(separator - argv);
  for (int k = own + 1; k < argc; ++k) take_benchmark_argument(argv[k], options);
  refuse_replaced(own, argv);
  parse_command_line(app, own, argv);

  const auto given = [&](const char* option) { return app.get_option(option)->count() > 0; };
  for (const char* of_bodies : {"--mesh", "--scene", "--figure", "--adapt", "--fields"})
    if (!options.run.problems.empty() && given(of_bodies))
      throw UsageError(fmt::format("{}: not with --problem, which has no body", of_bodies));
  read_study(texts.study, options.run);
  if (!options.run.problems.empty() && given("--study") &&
      options.run.study.points != Study::Points::contact)
    throw UsageError("--study: not with --problem, which has no body (allowed: contact)");
  for (const auto& [name, value] : options.run.study.options) {
    try {
      if (given(name.c_str())) continue;
      app.get_option(name)->add_result(value);
      app.get_option(name)->run_callback();
    } catch (const CLI::Error& wrong) {
      throw UsageError(fmt::format("--study: the options of {}: {}", options.run.study.name,
                                   shortened(wrong.what(), 300)));
    }
  }
  options.run.cases.stop = *stop_of(texts.stop);
  if (given("--contact")) options.run.cases.contact = contact_solver_of(texts.contact);
  read_repetitions(texts.repetitions, options.limits);
  if (given("--retry-noisy")) {
    constexpr double max_noise = 0.05;  // as in machine_warnings()
    options.limits.retry_noisy = texts.noise == "true"
                                     ? max_noise
                                     : share_of("--retry-noisy", texts.noise, "as 5%, or no value");
  }
  read_threads(texts.threads, given("--threads"), options.run);
  read_timeout(texts.timeout, given("--timeout"), options.run.budgets_s, options.limits);
  if (given("--adapt")) read_adapt(texts.adapt, options.run.adapt);
  if (given("--degree")) {  // next to programs, and in a study, HYBRID is one of several
    const RunSettings& run = options.run;
    const bool has_others =
        given("--method") || run.figure || !run.externals.empty() || !run.study.name.empty();
    read_degree(texts.degree, has_others, options.run);
  }
  if (!texts.columns.empty()) options.output.columns = split_list(texts.columns);
  if (!texts.shard.empty()) {
    const std::optional<Shard> part = shard_of(texts.shard);
    if (!part) refuse("--shard", texts.shard, "k/n with 1 <= k <= n");
    options.run.shard = *part;
  }
  if (given("--fields")) read_fields(texts.fields, options.run.cases);
  refuse_contradictions(options);
  if (options.run.study.once) options.limits.repetitions = 1;
  return options;
}

}  // namespace airybench
