#include "bench/check/program_check.hpp"

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
  bool is_answered = false;    // with finite forces, as many as there should be
  double off = 0;              // of these, relative to the right ones
  Names laws;                  // that the right answer needs
};

constexpr const char *friction_law = "the friction law: where no point slips it is right",
                     *opening = "the opening of points: where none opens it is right";

// The condensed problem in the rows of the program's F_C, and its solution.
struct Condensed {
  contact::Problem problem;
  Eigen::VectorXd F_C;
};

Condensed condensed_of(const Method& program, const PosedScene& scene) {
  const Method ours = select_methods(program.in_displacements() ? "P2" : "HYBRID").front();
  Condensed result;
  RunControl control;
  control.contact.by = [&](const contact::Problem& problem) {
    result.problem = problem;
    return solve_contact(problem);
  };
  result.F_C = run(ours, contact_system(scene.body()), control).F_C;
  return result;
}

// In a line, with single spaces.
std::string in_short(const std::string& reason) {
  std::string line;
  for (const char c : reason)
    if (c != ' ' || !line.ends_with(' ')) line += c == '\n' ? ' ' : c;
  return line;
}

constexpr const char* too_early = "an iteration that ends too early";

std::string unnamed_forces(double off, double target) {
  constexpr double near = 0.05;
  if (off <= target) return "the contact forces are right, the rest of the answer is not";
  if (off <= near) return fmt::format("{}: forces are off by {:.0e}", too_early, off);
  return fmt::format("none of the known mistakes: forces are off by {:.2g} of theirs", off);
}

// Of the right forces: a friction law that is wrong by any factor is wrong where points slip.
Names laws_of(const ContactPoints& points, const Eigen::VectorXd& F) {
  constexpr double rounding = 1e-6;
  Names laws;
  const int m = points.components;
  for (int p = 0; p < points.count; ++p) {
    const double F_n = F(m * p), bound = points.friction_at(p) * -F_n;
    if (F_n >= -rounding * F.lpNorm<Eigen::Infinity>())
      laws.insert(opening);
    else if (m > 1 && std::abs(F(m * p + 1)) >= (1 - rounding) * bound)
      laws.insert(friction_law);
  }
  return laws;
}

void compare_forces(const Eigen::VectorXd& F, const Condensed& condensed, double target,
                    Compared& c) {
  const Eigen::VectorXd& right = condensed.F_C;
  const bool is_right = are_alike(F, right);
  c.is_answered = true;
  c.off = (F - right).norm() / right.norm();
  c.has_no_forces = F.isZero(0);
  Names fitting;
  for (const Mistake& mistake : mistakes_with(condensed.problem, right)) {
    const bool shows = mistake.F_C.size() > 0 && !are_alike(mistake.F_C, right);
    const bool fits = shows ? are_alike(F, mistake.F_C) : is_right;
    if (fits) fitting.insert(mistake.name);
    if (!fits && mistake.F_C.size() > 0) c.unlike.insert(mistake.name);
    if (fits && shows) c.like.insert(mistake.name);
  }
  for (const std::string& name : fitting) c.unlike.erase(name);
  if (!c.seen.passed)
    c.unnamed = c.has_no_forces ? "no forces at all" : unnamed_forces(c.off, target);
}

Compared check_case(const Method& program, const PosedScene& scene, const CaseSettings& asked,
                    const Limits& limits) {
  Compared c;
  c.seen.name = scene.scene_name;
  const std::string about = parse_json(scene.scene_definition).value("about", "");
  c.seen.made_for = about.substr(0, about.find(':'));
  c.about = about.substr(std::min(about.size(), c.seen.made_for.size() + 2));
  Eigen::VectorXd F;
  Method watched = program;
  watched.solve = [&](const ContactSystem& system, const RunControl& control) {
    Solution answer = program.solve(system, control);
    if (auto* const of = std::get_if<Displacements>(&answer.unknowns); of && of->by_program)
      of->by_program->allowed_penetration =
          std::max(of->by_program->allowed_penetration, allowed_penetration);
    F = answer.F_C;
    return answer;
  };
  const Verdict verdict =
      Workbench(scene.problem, asked, limits).examine({scene, watched, asked}, "").result.verdict;
  c.seen.verdict = name_of(verdict.status);
  c.seen.passed = verdict.status == Status::ok;
  const Condensed condensed = condensed_of(program, scene);
  c.laws = laws_of(condensed.problem.points, condensed.F_C);
  if (F.size() != condensed.F_C.size())
    c.unnamed = in_short(verdict.reason);
  else if (!F.allFinite())
    c.unnamed = "forces that are no numbers";
  else
    compare_forces(F, condensed, asked.target_error, c);
  return c;
}

Compared check_without_solution(const Method& program, const PosedScene& scene,
                                const Limits& limits) {
  Compared c;
  c.seen = {case_without_solution, "No solution", {}, {}, {}};
  RunControl control;
  control.deadline = Deadline::after(limits.timeout_s);
  const Solution answer = answer_without_solution(program, scene, control);
  c.seen.passed =  // by its own word: an answer that cannot be read is a breakdown, too
      answer.program &&
      (answer.status == Status::not_converged || answer.status == Status::breakdown);
  c.seen.verdict = c.seen.passed               ? "ok"
                   : has_answer(answer.status) ? "wrong ok"
                                               : std::string(name_of(answer.status));
  c.unnamed = has_answer(answer.status)
                  ? "an answer where there is none: say not_converged or breakdown"
                  : in_short(answer.message) + " (allowed: an answer.json that says so)";
  return c;
}

std::string text_of(const Names& names) { return fmt::format("{}", fmt::join(names, ", or ")); }

bool is_absolute_tolerance(const Compared& c, const std::vector<Compared>& all) {
  return c.seen.name == tiny_case && !c.seen.passed &&
         std::ranges::any_of(all, [](const Compared& other) {
           return other.seen.name == same_as_tiny && other.seen.passed;
         });
}

// Where no mistake explains all answers: what the cases that failed have in common, and no other.
std::string common_flaw(const std::vector<Compared>& all) {
  std::vector<const Compared*> failed;
  Names right;  // laws of the cases that passed
  bool has_passed = false;
  for (const Compared& c : all) {
    if (c.seen.name == case_without_solution || is_absolute_tolerance(c, all)) continue;
    if (!c.seen.passed) {
      failed.push_back(&c);
      continue;
    }
    has_passed = true;
    right.insert(c.laws.begin(), c.laws.end());
  }
  if (failed.empty()) return "";
  const auto all_failed = [&](const auto& is_so) { return std::ranges::all_of(failed, is_so); };
  if (!has_passed && all_failed([](const Compared* c) { return !c->is_answered; }))
    return "no answer: " + failed.front()->unnamed;
  if (!all_failed([](const Compared* c) { return c->is_answered; })) return "";
  for (const char* law : {friction_law, opening})
    if (has_passed && !right.contains(law) &&
        all_failed([&](const Compared* c) { return c->laws.contains(law); }))
      return fmt::format("something in {}", law);
  constexpr double converging = 0.5;
  const bool laws_are_right =
      has_passed && all_failed([&](const Compared* c) {
        return c->off <= converging && std::ranges::includes(right, c->laws);
      });
  if (laws_are_right) return fmt::format("{}: the same laws are right in other cases", too_early);
  if (all_failed([](const Compared* c) { return c->unnamed.starts_with(too_early); }))
    return too_early;
  return "";
}

// Names the mistakes that explain every answer, or else those that explain the case.
CheckReport conclude(std::vector<Compared>& all) {
  Names explain;
  for (const Compared& c : all) explain.insert(c.like.begin(), c.like.end());
  for (const Compared& c : all)
    for (const std::string& name : c.unlike) explain.erase(name);
  CheckReport report;
  report.conclusion = explain.empty() ? common_flaw(all) : text_of(explain);
  for (Compared& c : all) {
    Names like;
    std::ranges::set_intersection(c.like, explain, std::inserter(like, like.end()));
    c.seen.looks_like = c.seen.passed                         ? ""
                        : !like.empty()                       ? text_of(like)
                        : !c.like.empty() && !c.has_no_forces ? text_of(c.like)
                                                              : c.unnamed;
    if (is_absolute_tolerance(c, all))
      c.seen.looks_like = "an absolute tolerance: with a billion times the loads it is right";
    else if (!c.seen.passed && c.like.empty() && c.seen.verdict == "breakdown" && !c.about.empty())
      c.seen.looks_like = fmt::format("{} ({})", c.seen.looks_like, c.about);
    report.cases.push_back(c.seen);
  }
  return report;
}

}  // namespace

CheckReport check_program(const Method& program, const std::vector<PosedScene>& scenes,
                          const CaseSettings& asked, const Limits& limits,
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
      add(check_without_solution(program, scene, limits));
    }
    add(check_case(program, scene, asked, limits));
  }
  return conclude(all);
}

}  // namespace airybench
