#include "bench/check/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "bench/check/mistakes.hpp"
#include "bench/check/no_solution.hpp"
#include "bench/measure/workbench.hpp"
#include "bench/records/json.hpp"
#include "solvers/contact/condensed.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

using Names = std::set<std::string>;

// A weak contact law or a penalty on the cases' coarse mesh; a wrong gap is farther inside.
constexpr double allowed_penetration = 0.1;

constexpr const char *case_without_solution = "09_no_solution", *tiny_case = "10_tiny_loads",
                     *same_as_tiny = "03_sign_of_tangent";

// A case's answer next to those of the mistakes.
struct Compared {
  CheckedCase seen;
  std::string about;           // what its file says of it, without the title
  Names like, unlike;          // mistakes that the answer is, and is not, the one of
  std::string unnamed;         // what to say if no mistake is like it
  bool has_no_forces = false;  // as many mistakes lead to
  bool has_friction = false;
};

// The condensed problem in the rows of the program's F_C, and its solution.
struct Condensed {
  contact::Problem problem;
  Eigen::VectorXd F_C;
};

Condensed condensed_of(const Method& program, const PosedScene& scene) {
  const Method ours = select_methods(program.in_displacements ? "P2" : "HYBRID").front();
  Condensed result;
  RunControl control;
  control.contact.by = [&](const contact::Problem& problem) {
    result.problem = problem;
    return solve_contact(problem);
  };
  result.F_C = run(ours, assemble(scene.body(), ours.blocks), control).F_C;
  return result;
}

// In a line, with single spaces.
std::string in_short(const std::string& reason) {
  std::string line;
  for (const char c : reason)
    if (c != ' ' || !line.ends_with(' ')) line += c == '\n' ? ' ' : c;
  return line;
}

std::string unnamed_forces(const Eigen::VectorXd& F, const Eigen::VectorXd& right) {
  constexpr double near = 0.05;
  const double off = (F - right).norm() / right.norm();
  if (F.isZero(0)) return "no forces at all";
  if (off <= near)
    return fmt::format("an iteration that ends too early: forces are off by {:.0e}", off);
  return fmt::format("none of the known mistakes: forces are off by {:.2g} of theirs", off);
}

void compare_forces(const Eigen::VectorXd& F, const Condensed& condensed, Compared& c) {
  const Eigen::VectorXd& right = condensed.F_C;
  const bool is_right = are_alike(F, right);
  c.has_no_forces = F.isZero(0);
  for (const Mistake& mistake : mistakes_with(condensed.problem, right)) {
    const bool shows = mistake.F_C.size() > 0 && !are_alike(mistake.F_C, right);
    const bool fits = shows ? are_alike(F, mistake.F_C) : is_right;
    if (!fits && mistake.F_C.size() > 0) c.unlike.insert(mistake.name);
    if (fits && shows) c.like.insert(mistake.name);
  }
  if (is_right && !c.seen.passed)
    c.unnamed = "the contact forces are right, the rest of the answer is not";
  else if (!c.seen.passed)
    c.unnamed = unnamed_forces(F, right);
}

Compared check_case(const Method& program, const PosedScene& scene, const Options& options) {
  Compared c;
  c.seen.name = scene.scene_name;
  const std::string about = parse_json(scene.scene_definition).value("about", "");
  c.seen.made_for = about.substr(0, about.find(':'));
  c.about = about.substr(std::min(about.size(), c.seen.made_for.size() + 2));
  Eigen::VectorXd F;
  Method watched = program;
  watched.solve = [&](const DualSystem& system, const RunControl& control) {
    Solution answer = program.solve(system, control);
    if (answer.program)
      answer.program->allowed_penetration =
          std::max(answer.program->allowed_penetration, allowed_penetration);
    F = answer.F_C;
    return answer;
  };
  const Record record = Workbench(scene.problem, options).examine(watched, "").record;
  c.seen.verdict = name_of(record.status);
  c.seen.passed = record.status == Status::ok;
  const Condensed condensed = condensed_of(program, scene);
  c.has_friction = condensed.problem.points.components > 1;
  if (F.size() != condensed.F_C.size())
    c.unnamed = in_short(record.status_reason);
  else if (!F.allFinite())
    c.unnamed = "forces that are no numbers";
  else
    compare_forces(F, condensed, c);
  return c;
}

Compared check_without_solution(const Method& program, const PosedScene& scene,
                                const Options& options) {
  Compared c;
  c.seen = {case_without_solution, "No solution", {}, {}, {}};
  RunControl control;
  control.deadline = Deadline::after(options.timeout_s);
  const Solution answer = answer_without_solution(program, scene, control);
  c.seen.passed = answer.status == Status::not_converged || answer.status == Status::breakdown;
  c.seen.verdict = c.seen.passed               ? "ok"
                   : has_answer(answer.status) ? "wrong ok"
                                               : std::string(name_of(answer.status));
  c.unnamed = has_answer(answer.status)
                  ? "an answer where there is none: say not_converged or breakdown"
                  : in_short(answer.message) + " (allowed: an answer.json that says so)";
  return c;
}

std::string text_of(const Names& names) { return fmt::format("{}", fmt::join(names, ", or ")); }

// Names the mistakes that explain every answer, or else those that explain the case.
CheckReport conclude(std::vector<Compared>& all) {
  Names explain;
  for (const Compared& c : all) explain.insert(c.like.begin(), c.like.end());
  for (const Compared& c : all)
    for (const std::string& name : c.unlike) explain.erase(name);
  CheckReport report;
  report.conclusion = text_of(explain);
  const auto failed = [](const Compared& c) { return !c.seen.passed; };
  const auto right_or_with_friction = [](const Compared& c) {
    return c.seen.passed || c.has_friction || c.seen.name == case_without_solution;
  };
  const auto passes_without = [](const Compared& c) { return c.seen.passed && !c.has_friction; };
  if (explain.empty() && std::ranges::any_of(all, failed) &&
      std::ranges::all_of(all, right_or_with_friction) && std::ranges::any_of(all, passes_without))
    report.conclusion = "something in the friction law: what has no friction is right";
  const auto passed = [&](const char* name) {
    return std::ranges::any_of(
        all, [&](const Compared& c) { return c.seen.name == name && c.seen.passed; });
  };
  for (Compared& c : all) {
    Names like;
    std::ranges::set_intersection(c.like, explain, std::inserter(like, like.end()));
    c.seen.looks_like = c.seen.passed                         ? ""
                        : !like.empty()                       ? text_of(like)
                        : !c.like.empty() && !c.has_no_forces ? text_of(c.like)
                                                              : c.unnamed;
    if (c.seen.name == tiny_case && !c.seen.passed && passed(same_as_tiny))
      c.seen.looks_like = "an absolute tolerance: with a billion times the loads it is right";
    else if (!c.seen.passed && c.like.empty() && c.seen.verdict == "breakdown" && !c.about.empty())
      c.seen.looks_like = fmt::format("{} ({})", c.seen.looks_like, c.about);
    report.cases.push_back(c.seen);
  }
  return report;
}

}  // namespace

CheckReport check_program(const Method& program, const std::vector<PosedScene>& scenes,
                          const Options& options,
                          const std::function<void(const CheckedCase&)>& ended) {
  std::vector<Compared> all;
  const auto add = [&](Compared c) {
    ended(c.seen);
    all.push_back(std::move(c));
    throw_if_interrupted();
  };
  bool is_without_solution_asked = false;
  for (const PosedScene& scene : scenes) {
    if (!is_without_solution_asked && scene.scene_name > case_without_solution) {
      is_without_solution_asked = true;
      add(check_without_solution(program, scene, options));
    }
    add(check_case(program, scene, options));
  }
  return conclude(all);
}

}  // namespace airybench
