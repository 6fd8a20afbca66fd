#include "bench/commands/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>

#include "bench/commands/check_command.hpp"
#include "bench/commands/command_line.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/external/external_method.hpp"
#include "bench/measure/environment.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/new_scene.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record_files.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/prediction.hpp"
#include "bench/report/results_table.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/noise_watch.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "mesh/selection.hpp"
#include "solvers/methods.hpp"
#include "support/atomic_file.hpp"
#include "support/called_as.hpp"
#include "support/folder_lock.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

// The paper's figure shows SYMMLQ; its text says that 3STEPCG is alike.
constexpr const char* figure_3_methods = "SYMMLQ:*,3STEPCG:*";

constexpr const char* own_body_methods = "HYBRID,P2";

std::vector<Method> other_programs(const Options& options) {
  std::vector<Method> methods;
  for (const std::filesystem::path& file : options.run.externals) {
    for (const Declaration& of_value : for_every_value(read_declaration(file))) {
      Method method = external_method(of_value, options.limits.memory_limit_bytes);
      if (std::ranges::count(methods, method.name, &Method::name) > 0)
        throw UsageError(fmt::format("--external: {}: another file declares {} (allowed: one)",
                                     file.string(), method.name));
      methods.push_back(std::move(method));
    }
  }
  return methods;
}

void print_list(const std::vector<Method>& others) {
  fmt::print("meshes ({}):\n", mesh_directory().string());
  for (const std::string_view name : catalogue_mesh_names) fmt::print("  {}\n", name);
  fmt::print("methods (* of the paper, run by default):\n");
  std::vector<Method> all = methods();
  std::ranges::copy(others, std::back_inserter(all));
  for (const Method& method : all) {
    const std::string same =
        method.general_name.empty() ? "" : fmt::format(" (= {})", method.general_name);
    fmt::print("  {}{:<16}  {}{}\n", method.in_paper ? "*" : " ", method.name, method.summary,
               same);
  }
  fmt::print(
      "also: 3STEPCG:<preconditioner>[,refine=yes][,lanes=1],\n"
      "      SYMMLQ:<preconditioner>[,refine=yes][,schur=sparse][,lanes=1], ALM:r=<r>,rho=<rho>;\n"
      "      preconditioners: DTIC3..DTIC6, FLIC1..FLIC5, SSOR<0..2>, SKY, NONE;\n"
      "      EXTERNAL:<name> of the declarations of --external;\n"
      "      with --problem CONDENSED, the contact law alone by {}, and "
      "CONDENSED/contact=<solver>\n"
      "contact solvers (--contact, {} by default): {}\n"
      "studies (--study):\n",
      name_of(ContactSolver::newton), name_of(ContactSolver::newton),
      fmt::join(names_of(all_contact_solvers), ", "));
  for (const Study& study : all_studies()) fmt::print("  {:<16}  {}\n", study.name, study.about);
}

void print_stages(const std::vector<Case>& plan) {
  for (const Case& c : plan) {
    const MeshSizes sizes = solved_sizes(c.posed.problem);
    const std::string of_body = body_of(c.posed.problem) == nullptr
                                    ? ""
                                    : fmt::format("n_phi {}, n_f {}, ", sizes.n_phi, sizes.n_f);
    fmt::print("[{}/{}] {}  {}n_c {}\n", c.number, plan.size(), c.name().text(), of_body,
               sizes.n_c);
    for (const StageDecision& decision : decide_stages(c.posed.problem, c.method, false))
      fmt::print("    {:<9} {}{}{}\n", decision.run ? "run" : "left out", decision.stage,
                 decision.run ? "" : ": ", decision.reason);
  }
}

void print_left_out(const std::vector<Case>& plan) {
  std::map<std::pair<std::string, std::string>, int> cases_without;  // stage, reason
  for (const Case& c : plan)
    for (const StageDecision& decision :
         decide_stages(c.posed.problem, c.method, c.settings.fields))
      if (!decision.run) ++cases_without[{decision.stage, decision.reason}];
  fmt::print("left out:\n");
  for (const auto& [what, count] : cases_without)
    fmt::print("  {:<36} {} (in {} of {} cases)\n", what.first, what.second, count, plan.size());
}

void print_prediction(const std::vector<Case>& plan, const Options& options) {
  std::vector<Record> planned;
  for (const Case& c : plan) planned.push_back(blank_record(c, options.limits));
  const PastRecords past = read_committed_records(planned, options.output.folder);
  for (const std::string& why : past.passed_over) std::cerr << fmt::format("{}\n", why);
  const RunLimits limits = limits_of(options.limits, plan);
  fmt::print("{}\n", prediction_table(planned, forecast(planned, past.records, limits), limits));
  print_left_out(plan);
}

void print_warnings(const std::vector<std::string>& of_machine, const EarlyPasses& early,
                    std::size_t cases) {
  for (const std::string& warning : of_machine) fmt::print("note: {}\n", warning);
  if (early.count() > 0)
    fmt::print(
        "note: {} of {} cases passed as quiet before the machine became quieter than it had been\n",
        early.count(), cases);
}

// The paper's methods are for its meshes: on another body they give the picture of HYBRID, later,
// and cannot solve bodies with holes.
std::vector<Method> methods_for(const std::vector<PosedScene>& scenes, const Options& options) {
  std::vector<Method> others = other_programs(options);
  if (!options.run.problems.empty()) {
    others.insert(others.begin(), condensed_contact());
    return options.run.methods.empty() ? others : select_methods(options.run.methods, others);
  }
  const int degree = options.run.degree.value_or(1);
  if (!options.run.methods.empty()) return select_methods(options.run.methods, others, degree);
  std::string names = default_methods(options.run.study);
  const auto is_own = [](const PosedScene& s) {
    return !is_named_after_catalogue(mesh_name_of(s.problem));
  };
  if (options.run.study.name.empty() && std::ranges::any_of(scenes, is_own))
    names = std::ranges::all_of(scenes, is_own) ? own_body_methods : names + "," + own_body_methods;
  if (!others.empty() && options.run.study.name.empty())  // next to what they are to beat
    names = std::ranges::any_of(scenes, is_own) ? own_body_methods : "HYBRID";
  if (!others.empty()) names += ",EXTERNAL:*";
  return select_methods(names, others, degree);
}

std::vector<PosedScene> levels_of(const std::vector<PosedScene>& scenes, const Options& options,
                                  std::vector<std::string>& short_of) {
  std::vector<PosedScene> levels;
  for (const PosedScene& start : scenes) {
    AdaptedScenes adapted = adapted_scenes(start, options);
    std::ranges::move(adapted.levels, std::back_inserter(levels));
    if (!adapted.why_not_reached.empty()) short_of.push_back(adapted.why_not_reached);
  }
  return levels;
}

// Of --adapt: goals that were not reached; --out is locked, as meshes are there.
struct Adapted {
  std::vector<std::string> short_of;
  std::optional<FolderLock> lock;
};

std::vector<Case> plan_of(const Options& options, Adapted& adapted) {
  std::vector<PosedScene> scenes = posed_scenes(options);
  if (!options.run.adapt.goals.empty()) check_adapting_method(options.run.adapt.by);
  if (!options.run.adapt.goals.empty() && (options.dry_run || options.explain)) {
    std::cerr
        << "note: --adapt: of the first level alone; the others are known when it is solved\n";
  } else if (!options.run.adapt.goals.empty()) {
    make_folder(options.output.folder);
    adapted.lock.emplace(options.output.folder);
    scenes = levels_of(scenes, options, adapted.short_of);
  }
  std::vector<Case> plan = plan_cases(scenes, methods_for(scenes, options), options.run);
  if (!options.run.filter.empty()) plan = matching(std::move(plan), options.run.filter);
  if (plan.empty() && adapted.short_of.empty())
    throw UsageError("no case is left: the arguments after -- select none");
  return plan;
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
  Options options = parse_options(argc, argv);
  if (options.run.figure) {
    options.run.meshes = *options.run.figure == 3 ? "Mesh3" : "Mesh0..Mesh7";
    options.run.methods =
        *options.run.figure == 3 ? figure_3_methods : default_methods(options.run.study);
  }
  const bool only_plans = options.explain || options.dry_run;
  if (options.list || only_plans) require_standard_output();
  if (options.list) {
    print_list(other_programs(options));
    return all_ok;
  }
  if (!options.new_scene.empty()) {
    const std::string scene = write_new_scene(options.new_scene, options.run.model_settings);
    fmt::print(
        "{0}: fill it in, then for its answer: {1} solve {2} {3}\n"
        "to compare methods: {1} --mesh={2} --scene={3}\n",
        scene, called_as("bench"), shell_word(options.new_scene.string()), shell_word(scene));
    return all_ok;
  }
  if (!options.new_external.empty()) return new_external(options.new_external);
  if (!options.check.empty()) return check_external(std::move(options));
  if (!only_plans) require_threads(options.run.cases.threads);
  if (!only_plans) check_takes_records(options.output.folder);  // before meshes are written there
  if (!options.run.adapt.goals.empty() && !only_plans)
    catch_interrupts();  // adapting solves; a signal just ends other planning
  Adapted adapted;
  const std::vector<Case> whole = plan_of(options, adapted);
  for (const std::string& why : adapted.short_of) std::cerr << fmt::format("note: {}\n", why);
  if (whole.empty()) return some_case_failed;
  const std::vector<Case> plan = part_of(whole, options.run.shard);
  if (plan.empty())
    throw UsageError(
        fmt::format("--shard: {} (there are {} cases)", name_of(options.run.shard), whole.size()));
  if (options.explain) print_stages(plan);
  if (options.dry_run) print_prediction(plan, options);
  if (only_plans) return all_ok;
  set_threads(options.run.cases.threads);
  catch_interrupts();
  if (const auto records = options.output.folder / "records.jsonl";
      !options.output.append && !options.output.resume && std::filesystem::exists(records))
    std::cerr << fmt::format("note: {}: this run replaces its records (--append keeps them)\n",
                             options.output.folder.string());
  Context context = context_of_run(options);
  context["cases_planned"] = std::to_string(whole.size());
  context["plan_sha256"] = fingerprint(whole);
  const RunResult result = run_cases(plan, options.limits, options.output, context);
  ResultsTable table;
  EarlyPasses early;
  std::vector<double> noise;
  std::vector<Record> beyond_goal;
  bool all_solved = adapted.short_of.empty();
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
