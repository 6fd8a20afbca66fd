#include "bench/commands/planned_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>

#include "bench/commands/run_parts.hpp"
#include "bench/external/external_method.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/record_files.hpp"
#include "bench/report/prediction.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "bench/run/runner.hpp"
#include "solvers/methods.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

// The paper's figure shows SYMMLQ; its text says that 3STEPCG is alike.
constexpr const char* figure_3_methods = "SYMMLQ:*,3STEPCG:*";

constexpr const char* own_body_methods = "HYBRID,P2";

void take_figure(int figure, RunSettings& run) {
  run.meshes = figure == 3 ? "Mesh3" : "Mesh0..Mesh7";
  run.methods = figure == 3 ? figure_3_methods : default_methods(run.study);
}

// The paper's methods are for its meshes: on another body they give the picture of HYBRID, later,
// and cannot solve bodies with holes.
std::vector<Method> methods_for(const std::vector<PosedScene>& scenes, const Options& options,
                                const std::vector<Method>& added) {
  std::vector<Method> others = other_programs(options.run.externals, options.limits);
  std::ranges::copy(added, std::back_inserter(others));
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

}  // namespace

std::vector<Method> other_programs(const std::vector<std::filesystem::path>& declarations,
                                   const Limits& limits) {
  std::vector<Method> methods;
  for (const std::filesystem::path& file : declarations) {
    for (const Declaration& of_value : for_every_value(read_declaration(file))) {
      Method method = external_method(of_value, limits.memory_limit_bytes);
      if (std::ranges::count(methods, method.name, &Method::name) > 0)
        throw UsageError(fmt::format("--external: {}: another file declares {} (allowed: one)",
                                     file.string(), method.name));
      methods.push_back(std::move(method));
    }
  }
  return methods;
}

PlannedCases planned_cases(Options options, const std::vector<Method>& added) {
  if (options.run.figure) take_figure(*options.run.figure, options.run);
  PlannedCases planned;
  std::vector<PosedScene> scenes = posed_scenes(options);
  const bool adapts = !options.run.adapt.goals.empty();
  if (adapts) adapting_method(options.run.adapt.by);
  if (adapts && options.dry_run) {
    std::cerr
        << "note: --adapt: of the first level alone; the others are known when it is solved\n";
  } else if (adapts) {
    make_folder(options.output.folder);
    planned.lock = std::make_unique<FolderLock>(options.output.folder);
    scenes = levels_of(scenes, options, planned.short_of);
  }
  planned.whole = plan_cases(scenes, methods_for(scenes, options, added), options.run);
  if (!options.run.filter.empty())
    planned.whole = matching(std::move(planned.whole), options.run.filter);
  if (planned.whole.empty() && planned.short_of.empty())
    throw UsageError("no case is left: the arguments after -- select none");
  planned.part = part_of(planned.whole, options.run.shard);
  if (planned.part.empty() && !planned.whole.empty())
    throw UsageError(fmt::format("--shard: {} (there are {} cases)", name_of(options.run.shard),
                                 planned.whole.size()));
  return planned;
}

void print_forecast(const std::vector<Case>& plan, const Options& options) {
  std::vector<Record> planned;
  for (const Case& c : plan) planned.push_back(blank_record(c, options.limits));
  const PastRecords past = read_committed_records(planned, options.output.folder);
  for (const std::string& why : past.passed_over) std::cerr << fmt::format("{}\n", why);
  const RunLimits limits = limits_of(options.limits, plan);
  fmt::print("{}\n", prediction_table(planned, forecast(planned, past.records, limits), limits));
  print_left_out(plan);
}

}  // namespace airybench
