#include "bench/commands/command_options.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "bench/commands/command_line.hpp"
#include "bench/commands/measuring_options.hpp"
#include "bench/measure/build_info.hpp"
#include "bench/records/json.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

constexpr const char* run_footer = R"(
Other commands (each has --help)
  bench advise           which mesh and which method give an error that one chooses
  bench claims DIR       the paper's sentences, checked against a results folder
  bench compare A,… B,…  two programs' runs, case by case: faster, slower, or not separated
  bench track            a night's run, added to a history and judged
  bench export DIR       records for Google Benchmark's tools, trackers, JUnit
  bench export-problem   a problem's matrices, for solvers of one's own
  bench merge DIR...     the shards of a run, joined
  bench replay RECORD    one recorded case, run again

Everything after "--" goes to Google Benchmark.

Exit status  0  every case is ok, or skipped with a reason
             1  some case is not, or a mesh could not be adapted as far as --adapt says
             2  wrong usage, or a file that cannot be used or written: one line on standard error
             3  out of memory, or a defect of bench itself: one line on standard error (so with every
                command)
         128+n  ended by signal n (Ctrl-C: 130); what was measured is in the folder

Examples
  bench --mesh=Mesh0..Mesh7 --method='3STEPD*'
  bench --figure=3 --out=results/figure3
  bench --study=error --mesh=Mesh0..Mesh3 --out=results/error
  bench --study=stability --out=results/stability
  bench --study=adapted --out=results/adapted
  bench --mesh=Mesh0,Mesh4 --method=HYBRID,P2 --adapt=0.3% --out=results/adapted
  bench --mesh=Mesh0..Mesh7 --out=results/night --resume
  bench --mesh=Mesh0..Mesh7 --shard=2/4 --out=results/part2
  bench --mesh=part.geo --role=clamped=displacement --mesh-size=50%
  bench --mesh=Mesh3,part.msh --scene=flat.json --repetitions=11 --out=results/flat
)";

// What Google Benchmark is told, kept as options: the plan and the records must show it.
void take_benchmark_argument(const std::string& argument, Options& options) {
  const auto value_of = [&](std::string_view option) -> std::optional<std::string> {
    if (!argument.starts_with(option)) return {};
    return argument.substr(option.size());
  };
  if (const auto filter = value_of("--benchmark_filter=")) {
    options.filter = *filter;
  } else if (const auto pair = value_of("--benchmark_context=")) {
    const std::size_t equals = pair->find('=');
    if (equals == pair->npos || equals == 0 || !is_utf8(*pair))
      throw UsageError(fmt::format("-- --benchmark_context={}: (allowed: key=value in UTF-8)",
                                   is_utf8(*pair) ? shortened(*pair) : "…"));
    options.own_context[pair->substr(0, equals)] = pair->substr(equals + 1);
  } else if (const auto word = value_of("--benchmark_enable_random_interleaving=")) {
    if (*word != "true" && *word != "false")
      throw UsageError(fmt::format(
          "-- --benchmark_enable_random_interleaving={} (allowed: true, false)", shortened(*word)));
    options.interleave = *word == "true";
  } else {
    throw UsageError(
        fmt::format("-- {}: not for bench's runs (allowed: --benchmark_filter=, "
                    "--benchmark_enable_random_interleaving=, --benchmark_context=)",
                    shortened(argument)));
  }
}

// The file of that name, or those that a glob matches; one that matches nothing is a file's name.
std::vector<std::filesystem::path> files_of(const std::string& item) {
  if (std::error_code error; std::filesystem::exists(item, error)) return {item};
  glob_t found = {};
  glob(item.c_str(), GLOB_NOCHECK, nullptr, &found);
  std::vector<std::filesystem::path> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

void add_files(CLI::App& app, const char* option, std::vector<std::filesystem::path>& files,
               const std::string& about) {
  app.add_option_function<std::vector<std::string>>(
      option,
      [&files](const std::vector<std::string>& lists) {
        for (const std::string& list : lists)
          for (const std::string& item : split_list(list))
            std::ranges::copy(files_of(item), std::back_inserter(files));
      },
      about);
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app(
      "Time, memory and error of methods for stress-formulated contact with friction, for every "
      "mesh, scene and method chosen.",
      "bench");
  app.footer(run_footer);
  app.set_version_flag("--version", std::string("airybench ") + build_info.version);
  app.add_option(
         "--mesh", options.meshes,
         "range (Mesh0..Mesh7), list (Mesh0,Mesh3), glob, or files (in a name a comma is \\,): "
         "meshes, *.msh, and Gmsh models, *.geo, *.step, *.brep, *.iges, which meshgen converts")
      ->capture_default_str();
  add_model_settings(app, options.model_settings);
  app.add_option(
      "--method", options.methods,
      "names or globs, separated by commas; default: all the paper's methods, for bodies "
      "with holes also HYBRID and P2");
  add_files(app, "--scene", options.scenes,
            "scene file(s) or globs, separated by commas (in a name a comma is \\,); default: the "
            "documented "
            "tooth or rack");
  add_files(app, "--problem", options.problems,
            "instead of meshes and scenes, condensed contact problems in FCLIB's format, files or "
            "globs separated by commas: every contact solver (--contact: that one) on each");
  add_files(app, "--external", options.externals,
            "declaration(s) of other programs that solve our problems, files or globs separated by "
            "commas: each is a "
            "method EXTERNAL:name, beside those of --method's default or chosen by it "
            "(docs/external-solvers.md)");
  add_whole(
      app, "--figure", 3, 5, 0,
      [&](std::int64_t figure) { options.figure = static_cast<int>(figure); },
      "the cases of the paper's figure 3, 4 or 5, and those that we set beside them (4 and 5 are "
      "the "
      "same)")
      ->excludes(app.get_option("--mesh"))
      ->excludes(app.get_option("--method"));
  std::string study;
  app.add_option("--study", study,
                 "error (every method over its accuracy knob: what each digit costs), stability "
                 "(every method on the extreme scenes of bench/scenes/stability), contact (every "
                 "contact solver on the same condensed problems, bench/scenes/contact), adapted "
                 "(the methods on adapted meshes of tooth and rack: --adapt=1.5%,0.5%,0.15% "
                 "--levels=last), load-steps (paths of 1 to 50 steps, bench/scenes/load-steps) or "
                 "scaling (every method on 1, 2, … threads)")
      ->check(CLI::IsMember(names_of(all_studies)))
      ->excludes(app.get_option("--figure"));
  add_number(
      app, "--target-error", Least::above_zero, most_of_a_limit, options.target_error,
      "every iterative method is tightened until its own estimate of its error is below this; a "
      "case whose errors, as verified, are above is `inaccurate`");
  std::string stop = "target";
  app.add_option("--stop", stop,
                 "when iterative methods stop: target (see --target-error), or paper (the paper's "
                 "own stops, whatever error they leave)")
      ->check(CLI::IsMember({"target", "paper"}))
      ->capture_default_str();
  std::string contact = "newton";
  app.add_option("--contact", contact,
                 "what solves the condensed contact problem: newton (active sets after a few "
                 "sweeps), gauss-seidel (as the paper has it), anderson (the same, accelerated) or "
                 "admm; ALM and HYBRID:CG condense none, and have their own")
      ->check(CLI::IsMember(names_of(all_contact_solvers)))
      ->capture_default_str();
  add_whole(
      app, "--repetitions", 1, 100000, options.repetitions,
      [&](std::int64_t count) { options.repetitions = static_cast<int>(count); },
      "timed runs of each case");
  std::string precision;
  CLI::Option* precise = app.add_option(
      "--precision", precision,
      "a share, as 2%: timed runs go on after --repetitions until both ends of the 95 % interval "
      "of "
      "the median time are at most so far from it; at most --max-repetitions, or --long-case "
      "seconds of solves; the record says whether it was reached");
  add_whole(
      app, "--max-repetitions", 1, 100000, options.max_repetitions,
      [&](std::int64_t count) { options.max_repetitions = static_cast<int>(count); },
      "with --precision: the most timed runs of each case")
      ->needs(precise);
  std::string noise;
  CLI::Option* retries = app.add_flag(
      "--retry-noisy", noise,
      "measure a case again, up to three times, where the calibration loop beside it scattered or "
      "was slower than on the quiet machine by more than this share (--retry-noisy=7%; default "
      "5%); "
      "the least noisy attempt is kept, and the record says how noisy it was");
  std::string threads = "1";
  CLI::Option* given_threads =
      app.add_option(
             "--threads", threads,
             "threads of BLAS and for right-hand sides; with --study=scaling a list (1,2,4; "
             "1 is always among them), by default 1, 2, 4, … up to the processors")
          ->capture_default_str();
  add_number(app, "--timeout", Least::above_zero, most_of_a_limit, options.timeout_s,
             "seconds that one solve may take; one that does not end by itself is ended");
  double tuning_budget_s = options.timeout_s;
  CLI::Option* tuning_budget =
      add_number(
          app, "--tuning-budget", Least::above_zero, most_of_a_limit, tuning_budget_s,
          "seconds that each case may search for parameters and tolerances: no other is tried "
          "afterwards, and the best found is kept; default: --timeout, and six tolerances")
          ->default_str("");
  std::string budgets;
  CLI::Option* budget = app.add_option(
      "--budget", budgets,
      "with --study=error: seconds, one or several (0.01,0.1): the least error of every method "
      "with "
      "a solve of at most that time (figures/budget.csv); a solve is ended at twice the largest");
  add_number(
      app, "--long-case", Least::above_zero, most_of_a_limit, options.long_case_s,
      "seconds: a longer solve is measured once, and repetitions end when they add up to this");
  add_whole(
      app, "--memory-limit", 1, std::int64_t{1} << 40, 0,
      [&](std::int64_t MiB) { options.memory_limit_bytes = MiB * 1024 * 1024; },
      "MiB of heap that one solve may use, its blocks included");
  std::string adapt;
  CLI::Option* adapts = app.add_option(
      "--adapt", adapt,
      "refine each mesh where the error is, until this total error (1%) or number of unknowns "
      "(50000), or one after the other (1.5%,0.5%); the methods are measured on the meshes on the "
      "way, which are kept in OUT/meshes");
  app.add_option("--adapt-by", options.adapt_by, "the method that solves for the error")
      ->capture_default_str()
      ->needs(adapts);
  double marking = 0.75;
  add_number(
      app, "--marking", Least::above_zero, 1, marking,
      "bulk marking: each level refines the triangles that hold this part of the squared "
      "error (1: all, each into four); default: fewer levels, each as fine as its errors are "
      "expected to need")
      ->default_str("")
      ->needs(adapts);
  std::string levels = "all";
  app.add_option("--levels", levels,
                 "on which of these meshes methods are measured: all, last (those that "
                 "reach a total error or number that --adapt names)")
      ->check(CLI::IsMember({"all", "last"}))
      ->capture_default_str()
      ->needs(adapts);
  app.add_option("--out", options.out, "folder of the output files")->capture_default_str();
  app.add_option("--then", options.then,
                 "a command for the shell after the run; the output folder becomes its last "
                 "argument, its exit status does not matter");
  app.add_flag("--append", options.append,
               "keep the records in the folder, but those of the cases that are run");
  app.add_flag("--resume", options.resume,
               "go on with the run in the folder: only the cases that have no record are run; the "
               "records must be of this machine, program and options")
      ->excludes(app.get_option("--append"));
  std::string shard;
  app.add_option("--shard", shard,
                 "k/n: the k-th of n parts of the cases, for n machines (bench merge joins them)");
  app.add_flag("--interleave", options.interleave,
               "the repetitions of a scene's cases in random turn, so that the machine's moods "
               "fall on all alike; their records are written when all have theirs");
  std::string fields;
  app.add_flag(
      "--fields", fields,
      "also write stresses, displacements, contact points and shares in the error (fields/*.csv, "
      "*.vtu for ParaView), and with them the total error; --fields=mean: and the mean of "
      "the stresses with those of admissible displacements, which has half of the bound "
      "of the error");
  app.add_flag("--histories", options.histories, "keep iteration histories in records.jsonl");
  app.add_flag("--list", options.list, "print meshes and methods, and end");
  app.add_flag("--dry-run", options.dry_run,
               "print the cases, what they will take (from earlier records) and what is left out, "
               "and end");
  app.add_flag("--explain", options.explain,
               "print each case's stages, those left out and why, and end");

  int own = argc;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--") == 0) {
      own = i;
      for (int k = i + 1; k < argc; ++k) take_benchmark_argument(argv[k], options);
      break;
    }
  parse_command_line(app, own, argv);
  if (!shard.empty()) {
    const std::optional<Shard> part = shard_of(shard);
    if (!part)
      throw UsageError(
          fmt::format("--shard: {} (allowed: k/n with 1 <= k <= n)", shortened(shard)));
    options.shard = *part;
  }
  options.study = study_of(study);
  if (precise->count() > 0) read_precision(precision, options);
  if (retries->count() > 0) read_retry_noisy(noise, options);
  if (options.study == Study::adapted && adapt.empty()) {
    adapt = "1.5%,0.5%,0.15%";
    levels = "last";
  }
  if (!adapt.empty()) {
    for (const std::string& goal : split_list(adapt)) {
      const std::optional<AdaptGoal> one = adapt_goal_of(goal);
      if (!one)
        throw UsageError(
            fmt::format("--adapt: {} (allowed: a total error above 0% and below 100%, as "
                        "1%, or a number of unknowns from 1 to 5000000)",
                        shortened(goal)));
      options.adapt.push_back(*one);
    }
    if (options.dry_run || options.explain)
      throw UsageError("--adapt: not with --dry-run or --explain: the meshes are not there yet");
  }
  if (app.get_option("--marking")->count() > 0) options.marking = marking;
  options.goals_only = levels == "last";
  options.fields = app.get_option("--fields")->count() > 0;
  options.mean_fields = fields == "mean";
  if (options.fields && fields != "true" && !options.mean_fields)
    throw UsageError(fmt::format("--fields: {} (allowed: mean, or no value)", shortened(fields)));
  if (stop == "paper") options.stop = Stop::paper;
  if (app.get_option("--contact")->count() > 0) {
    options.contact = contact_solver_of(contact);
    if (options.stop == Stop::paper)
      throw UsageError("--contact: not with --stop=paper, whose contact law is gauss-seidel");
    if (options.study == Study::contact)
      throw UsageError("--contact: not with --study=contact, which has all of them");
  }
  if (!options.problems.empty())
    for (const char* of_bodies :
         {"--mesh", "--scene", "--figure", "--study", "--adapt", "--fields"})
      if (app.get_option(of_bodies)->count() > 0)
        throw UsageError(fmt::format("{}: not with --problem, which has no body", of_bodies));
  if (options.study == Study::error && options.stop == Stop::paper)
    throw UsageError("--stop=paper: not with --study=error, which has the paper's stop as a point");
  if (options.study == Study::contact && options.stop == Stop::paper)
    throw UsageError("--stop=paper: not with --study=contact, whose solvers are not the paper's");
  if (const std::optional<StudyDefaults> defaults = defaults_of(options.study)) {
    if (app.get_option("--mesh")->count() == 0) options.meshes = defaults->meshes;
    if (app.get_option("--timeout")->count() == 0) options.timeout_s = defaults->timeout_s;
  }
  if (options.study == Study::scaling && options.interleave)
    throw UsageError(
        "--interleave: not with --study=scaling: BLAS's idle threads of one case are awake in "
        "another's time");
  if (options.study == Study::stability) options.repetitions = 1;
  if (tuning_budget->count() > 0) options.tuning_budget_s = tuning_budget_s;
  if (budget->count() > 0) read_budgets(budgets, app.get_option("--timeout")->count() > 0, options);
  read_threads(threads, given_threads->count() > 0, options);
  return options;
}

}  // namespace airybench
