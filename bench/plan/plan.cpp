#include "bench/plan/plan.hpp"

#include <fmt/format.h>

#include "bench/plan/stages.hpp"
#include "support/sha256.hpp"

namespace airybench {

namespace {

std::vector<TurnedMethod> points_of(const Method& method, bool has_no_body,
                                    const Options& options) {
  using enum Study::Points;
  if (options.study.points == accuracy) return error_points(method);
  if (options.study.points == threads) return scaling_points(method, options.thread_counts);
  if (options.study.points == contact || (has_no_body && !options.contact))
    return contact_points(method);
  return {{method, {}}};
}

std::optional<ContactSolver> contact_solver(const Case& planned, const Options& options) {
  const PosedProblem& problem = planned.posed.problem;
  const Method& method = planned.method;
  if (!(method.condenses_contact() || body_of(problem) == nullptr) || !method.program.empty() ||
      solved_sizes(problem).n_c == 0)
    return {};
  const ContactSolver implied = implied_contact_solver(planned.stop, planned.knob.name);
  if (implied != ContactSolver::newton) return implied;
  return planned.knob.contact.value_or(options.contact.value_or(implied));
}

}  // namespace

std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, const Options& options) {
  std::vector<Case> cases;
  for (const PosedScene& scene : scenes)
    for (const Method& method : methods)
      for (TurnedMethod& point : points_of(method, body_of(scene.problem) == nullptr, options)) {
        Case& added = cases.emplace_back(Case{scene, std::move(point.method), std::move(point.knob),
                                              static_cast<int>(cases.size()) + 1,
                                              options.study.name, options.stop});
        added.stop = added.knob.stop.value_or(options.stop);
        added.contact = contact_solver(added, options);
      }
  return cases;
}

const Problem* body_of(const PosedProblem& problem) { return held<Problem>(problem).get(); }

std::string mesh_name_of(const PosedProblem& problem) {
  const Problem* const body = body_of(problem);
  return body != nullptr ? body->mesh.name : held<contact::Problem>(problem)->name;
}

CaseName Case::name() const {
  return {mesh_name_of(posed.problem),
          posed.scene_name,
          method.name,
          study,
          knob.name,
          knob.value,
          stop,
          unless_implied(contact, stop, knob.name)};
}

std::string fingerprint(const std::vector<Case>& plan) {
  std::string text;
  for (const Case& c : plan)
    text +=
        fmt::format("{} {} {}\n", c.name().text(), c.posed.mesh_sha256, c.posed.scene_definition);
  return sha256_hex(text);
}

std::vector<Case> part_of(const std::vector<Case>& plan, const Shard& shard) {
  std::vector<Case> part;
  for (const Case& c : plan)
    if ((c.number - 1) % shard.count == shard.index - 1) part.push_back(c);
  return part;
}

}  // namespace airybench
