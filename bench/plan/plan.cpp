#include "bench/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "bench/plan/stages.hpp"
#include "support/numbers.hpp"
#include "support/sha256.hpp"

namespace airybench {

std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, Study study, Stop stop,
                             std::optional<ContactSolver> contact,
                             const std::vector<int>& thread_counts) {
  std::vector<Case> cases;
  const auto add = [&](const PosedScene& scene, Method method, Knob knob) {
    const Stop own_stop = knob.stop.value_or(stop);
    std::optional<ContactSolver> solver;
    if ((method.condenses_contact() || !body_of(scene.problem)) && method.program.empty() &&
        solved_sizes(scene.problem).n_c > 0) {
      solver = implied_contact_solver(own_stop, knob.name);
      if (*solver == ContactSolver::newton)
        solver = knob.contact.value_or(contact.value_or(ContactSolver::newton));
    }
    cases.push_back({scene, std::move(method), std::move(knob), static_cast<int>(cases.size()) + 1,
                     study, own_stop, solver});
  };
  for (const PosedScene& scene : scenes)
    for (const Method& method : methods)
      if (study == Study::error)
        for (TurnedMethod& point : error_points(method))
          add(scene, std::move(point.method), std::move(point.knob));
      else if (study == Study::contact || (!body_of(scene.problem) && !contact))
        for (TurnedMethod& point : contact_points(method))
          add(scene, std::move(point.method), std::move(point.knob));
      else if (study == Study::scaling)
        for (TurnedMethod& point : scaling_points(method, thread_counts))
          add(scene, std::move(point.method), std::move(point.knob));
      else
        add(scene, method, {});
  return cases;
}

const Problem* body_of(const PosedProblem& problem) {
  const auto* const body = std::get_if<std::shared_ptr<const Problem>>(&problem);
  return body != nullptr ? body->get() : nullptr;
}

std::string mesh_name_of(const PosedProblem& problem) {
  const Problem* const body = body_of(problem);
  return body != nullptr ? body->mesh.name : std::get<1>(problem)->name;
}

CaseName Case::name() const {
  return {mesh_name_of(posed.problem),
          posed.scene_name,
          method.name,
          name_of(study),
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

std::string name_of(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

std::optional<Shard> shard_of(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::optional<std::int64_t> index = parse_whole(text.substr(0, slash));
  const std::optional<std::int64_t> count =
      parse_whole(text.substr(std::min(slash + 1, text.size())));
  if (!index || !count || *index < 1 || *index > *count || *count > std::numeric_limits<int>::max())
    return {};
  return Shard{static_cast<int>(*index), static_cast<int>(*count)};
}

std::vector<Case> part_of(const std::vector<Case>& plan, const Shard& shard) {
  std::vector<Case> part;
  for (const Case& c : plan)
    if ((c.number - 1) % shard.count == shard.index - 1) part.push_back(c);
  return part;
}

}  // namespace airybench
