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
  if (options.study.points == contact && has_no_body) return precision_points(method);
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

void describe(const Method& method, Record& record) {
  take_over(method, record);
  record.method = method.name;
  record.general_name = method.identity();
  record.iterative = method.is_iterative();
}

Record blank_record(const PosedProblem& problem, const Method& method, const Options& options) {
  const Problem* const body = body_of(problem);
  const MeshSizes sizes = solved_sizes(problem);
  Record record;
  record.status_reason = "the case did not run";
  if (std::string why = why_skipped(problem, method); !why.empty()) {
    record.status = Status::skipped;
    record.status_reason = std::move(why);
  }
  record.mesh = mesh_name_of(problem);
  if (body != nullptr) take_over(extent_of(body->mesh), record);
  describe(method, record);
  take_over(options, record);
  if (method.target_error) record.target_error = method.target_error;
  record.study = options.study.name;
  if (body != nullptr) {
    record.n_phi = sizes.n_phi;
    record.n_f = sizes.n_f;
  }
  record.n_c = sizes.n_c;
  if (body == nullptr) record.contact_matrix = held<contact::Problem>(problem)->how;
  record.load_steps = body != nullptr ? 1 + std::ssize(body->later_steps) : 1;
  record.stages_left_out = Json::object();
  for (const StageDecision& decision : decide_stages(problem, method, options.fields)) {
    if (decision.run)
      record.stages_run.push_back(decision.stage);
    else
      record.stages_left_out[decision.stage] = decision.reason;
  }
  return record;
}

Record blank_record(const Case& planned, const Options& options) {
  Record record = blank_record(planned.posed.problem, planned.method, options);
  identify(planned, record);
  return record;
}

void identify(const Case& planned, Record& record) {
  record.scene = planned.posed.scene_name;
  record.scene_group = planned.posed.scene_group;
  record.scene_definition = parse_json(planned.posed.scene_definition);
  record.mesh_file = planned.posed.mesh_file;
  record.mesh_sha256 = planned.posed.mesh_sha256;
  if (const auto& adapted = planned.posed.adapted) {
    record.adapt_level = adapted->level;
    record.adapt_time_s = adapted->time_s;
    record.adapt_estimate_share = adapted->estimate_share;
    record.smallest_angle_deg = adapted->smallest_angle_deg;
    record.adapt_goal = adapted->goal;
  }
  record.case_number = planned.number;
  record.knob = planned.knob.name;
  record.knob_value = planned.knob.value;
  if (planned.knob.threads) record.threads = *planned.knob.threads;
  record.study = planned.study;
  record.stop = planned.stop;
  record.contact_solver = planned.contact;
}

}  // namespace airybench
