#include "bench/plan/plan.hpp"

#include <fmt/format.h>

#include "bench/plan/stages.hpp"
#include "support/sha256.hpp"

namespace airybench {

namespace {

std::vector<TurnedMethod> points_of(const Method& method, bool is_given, const Options& options) {
  using enum Study::Points;
  if (options.study.points == accuracy) return error_points(method);
  if (options.study.points == threads) return scaling_points(method, options.thread_counts);
  if (options.study.points == contact || (is_given && !options.contact))
    return contact_points(method);
  return {{method, {}}};
}

std::optional<ContactSolver> contact_solver(const Case& planned, const Options& options) {
  const Problem& problem = *planned.posed.problem;
  const Method& method = planned.method;
  if (!(method.condenses_contact() || problem.given) || !method.program.empty() ||
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
      for (TurnedMethod& point : points_of(method, scene.problem->given != nullptr, options)) {
        Case& added = cases.emplace_back(Case{scene, std::move(point.method), std::move(point.knob),
                                              static_cast<int>(cases.size()) + 1,
                                              options.study.name, options.stop});
        added.stop = added.knob.stop.value_or(options.stop);
        added.contact = contact_solver(added, options);
      }
  return cases;
}

CaseName Case::name() const {
  return {posed.problem->mesh.name,
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
