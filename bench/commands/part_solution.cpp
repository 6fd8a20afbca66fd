#include "bench/commands/part_solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <vector>

#include "bench/commands/command_line.hpp"
#include "bench/measure/environment.hpp"
#include "bench/measure/step_fields.hpp"
#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "bench/records/summary.hpp"
#include "bench/run/adapted_scenes.hpp"
#include "solvers/methods.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

// Half the interval's width over the value.
std::optional<double> half_width(const std::optional<double>& low,
                                 const std::optional<double>& high,
                                 const std::optional<double>& value) {
  if (!low || !high || !value || *value == 0) return {};
  return (*high - *low) / 2 / std::abs(*value);
}
std::optional<double> half_width(const Json& of, const char* interval, double value) {
  if (!of.contains(interval)) return {};
  return half_width(of[interval][0].get<double>(), of[interval][1].get<double>(), value);
}

std::optional<SolvedPart> solved_to(const PosedScene& start, const Options& options,
                                    const std::vector<Method>& more) {
  const AdaptedScenes adapted = adapted_scenes(start, options);
  if (!adapted.why_not_reached.empty()) std::cerr << "note: " << adapted.why_not_reached << "\n";
  if (adapted.levels.empty()) return {};
  std::vector<Method> methods = select_methods(options.run.methods);
  std::ranges::copy(more, std::back_inserter(methods));
  const std::vector<Case> plan = plan_cases({adapted.levels.back()}, methods, options.run);
  RunResult result = run_cases(plan, options.limits, options.output, context_of_run(options));
  if (result.names.empty()) return {};
  Record record = result.record(0);
  const std::filesystem::path fields = options.output.folder / "fields" / name_of(record).file(),
                              of_part = fields.string() + ".answer.json";
  std::error_code error;
  Json part;
  if (std::filesystem::exists(of_part, error))
    part = json_of_file(of_part.string(), file_text(of_part));
  return SolvedPart{std::move(record), std::move(result), adapted.why_not_reached, fields,
                    std::move(part)};
}

}  // namespace

Options options_of_part() {
  Options options;
  options.limits.repetitions = 1;
  options.run.cases.fields = true;
  options.run.cases.timed_once = options.run.cases.intervals = true;
  options.run.adapt.goals_only = true;
  return options;
}

void ask_for(const PartGoal& goal, const std::string& degree, Options& options) {
  constexpr double of_stress = 2;  // times the error in energy
  options.run.adapt.goals = {{.error = goal.error, .unknowns = {}}};
  if (goal.of == PartQuantity::energy) options.run.adapt.stress_error = of_stress * goal.error;
  read_degree(degree, false, options.run);
}

Reached reached(const SolvedPart& solved, PartQuantity of) {
  constexpr double min_share = 0.01;
  const Record& r = solved.record;
  if (of == PartQuantity::energy) return {r.error_total};
  const bool is_force = of == PartQuantity::force;
  Reached worst{is_force ? half_width(r.normal_resultant_low_N, r.normal_resultant_high_N,
                                      r.normal_resultant_N)
                         : half_width(r.largest_pressure_low_MPa, r.largest_pressure_high_MPa,
                                      r.largest_pressure_MPa)};
  if (solved.part.is_null()) return worst;
  double load_N = 0;
  for (const Json& face : solved.part["faces"]) load_N += std::abs(face["normal_N"].get<double>());
  for (const Json& face : solved.part["faces"]) {
    const double force_N = face["normal_N"];
    const Json& pressure = face["pressure_MPa"];
    if (std::abs(force_N) <= min_share * load_N) continue;
    const Reached own{is_force ? half_width(face, "normal_in_N", force_N)
                               : half_width(pressure, "in", pressure["value"].get<double>()),
                      face["name"]};
    if (!own.error) return own;
    if (!worst.error || *own.error > *worst.error) worst = own;
  }
  return worst;
}

// The energy's error that the quantity's needs is found as the loop goes.
static std::optional<SolvedPart> solved_to_goal(const PosedScene& start, Options options,
                                                const PartGoal& goal,
                                                const std::vector<Method>& more) {
  constexpr int max_rounds = 5;
  constexpr double margin = 0.8, smallest_step = 0.1;
  // Of widths over errors, in two rounds: where it is lower, as beside a jump of the traction,
  // finer meshes are in vain.
  constexpr double min_order = 0.3;
  struct Round {
    double error, width;  // asked for in energy, had of the quantity
  };
  std::vector<Round> rounds;
  double& error = *options.run.adapt.goals.front().error;
  for (;;) {
    std::optional<SolvedPart> answer = solved_to(start, options, more);
    if (!answer || !answer->short_of.empty()) return answer;
    const std::optional<double> width = reached(*answer, goal.of).error;
    if (!width || meets(width, goal.error)) return answer;
    rounds.push_back({error, *width});
    if (rounds.size() > 2)
      if (const Round& before = rounds[rounds.size() - 3];
          std::min(*width, rounds[rounds.size() - 2].width) >
          before.width * std::pow(error / before.error, min_order)) {
        answer->short_of = fmt::format(
            "the interval no longer narrows: {:.3g} % at a total error of {:.3g} %, {:.3g} % at "
            "{:.3g} %",
            100 * before.width, 100 * before.error, 100 * *width, 100 * error);
        std::cerr << "note: " << answer->short_of << "\n";
        return answer;
      }
    if (rounds.size() == max_rounds) return answer;
    remove_fields(answer->fields.parent_path(), answer->fields.filename());
    error *= std::max(smallest_step, margin * std::min(goal.error / *width, 1.));
    std::cerr << fmt::format(
        "the {} is known to {:.3g} % at a total error of {:.3g} %; now {:.3g} %\n",
        goal.of == PartQuantity::force ? "force" : "largest pressure", 100 * *width,
        100 * rounds.back().error, 100 * error);
  }
}

static PosedScene in_equal_steps(PosedScene start, int steps, const Limits& limits) {
  const SceneFile file = in_equal_steps(scene_of_level_0(start), steps);
  start.scene_definition = file.definition();
  start.problem = pose_in_time(file.scene, start.scene_name, start.body()->mesh, limits);
  return start;
}

std::optional<SolvedPart> solved_part(const PosedScene& start, const Options& options,
                                      const PartGoal& goal, const std::vector<Method>& more) {
  std::optional<SolvedPart> answer = solved_to_goal(start, options, goal, more);
  if (!answer || options.run.equal_steps) return answer;
  const std::optional<double> change = answer->record.change_in_eight_steps;
  if (!change || *change <= goal.error) return answer;
  std::cerr << fmt::format(
      "note: faces slip, and eight load steps change the stresses by {:.2g} % in energy: solved in "
      "eight (--steps=1: in one)\n",
      100 * *change);
  auto path = solved_to_goal(in_equal_steps(start, 8, options.limits), options, goal, more);
  if (!path) return answer;
  if (path->fields != answer->fields)
    remove_fields(answer->fields.parent_path(), answer->fields.filename());
  return path;
}

}  // namespace airybench
