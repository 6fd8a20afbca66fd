#include "bench/plan/plan.hpp"

#include <fmt/format.h>

#include "assembly/problem/pose.hpp"
#include "bench/plan/stages.hpp"
#include "support/sha256.hpp"

namespace airybench {

namespace {

std::vector<StudyPoint> points_of(const Method& method, bool has_no_body, const RunSettings& run) {
  using enum Study::Points;
  const CaseSettings asked = common_settings(run);
  const Study::Points points = run.study.points;
  if (points == accuracy) return error_points(method, asked);
  if (points == threads) return scaling_points(asked, run.thread_counts);
  if (points == contact && has_no_body) return precision_points(method, asked);
  if (points == contact || (has_no_body && !asked.contact)) return contact_points(method, asked);
  return {{{}, asked}};
}

// Empty: there is no condensed contact problem.
std::optional<ContactSolver> contact_solver(const Case& planned) {
  const PosedProblem& problem = planned.posed.problem;
  const Method& method = planned.method;
  if (!(method.condenses_contact() || body_of(problem) == nullptr) || !method.program.empty() ||
      solved_sizes(problem).n_c == 0)
    return {};
  const ContactSolver implied = implied_contact_solver(planned.settings.stop, planned.knob.name);
  return implied != ContactSolver::newton ? implied : planned.settings.contact.value_or(implied);
}

}  // namespace

std::shared_ptr<const Problem> pose_in_time(const Scene& scene, const std::string& scene_name,
                                            Mesh mesh, const Limits& limits) {
  const TimeLimit limit =
      phase_limit(fmt::format("{}/{}: posing it", mesh.name, scene_name), limits);
  return std::make_shared<const Problem>(pose(scene, std::move(mesh)));
}

CaseSettings common_settings(const RunSettings& run) {
  CaseSettings asked = run.cases;
  asked.timed_once |= run.study.once;
  asked.condition = run.study.condition;
  asked.intervals = run.study.intervals || asked.fields || !run.adapt.goals.empty();
  asked.total_error_by_displacements = run.study.points == Study::Points::accuracy;
  asked.stresses_by = run.adapt.by;
  return asked;
}

std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, const RunSettings& run) {
  std::vector<Case> cases;
  for (const PosedScene& scene : scenes)
    for (const Method& method : methods)
      for (StudyPoint& point : points_of(method, body_of(scene.problem) == nullptr, run)) {
        Case& added = cases.emplace_back(
            Case{scene, method, std::move(point.settings), std::move(point.knob),
                 static_cast<int>(cases.size()) + 1, run.study.name, run.study.points});
        added.settings.contact = contact_solver(added);
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
          settings.stop,
          unless_implied(settings.contact, settings.stop, knob.name)};
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
  record.in_displacements = method.in_displacements();
  record.iterative = method.is_iterative();
}

Record blank_record(const Case& planned, const Limits& limits) {
  const auto& [posed, method, settings, knob, number, study, points] = planned;
  const PosedProblem& problem = posed.problem;
  const Problem* const body = body_of(problem);
  const MeshSizes sizes = solved_sizes(problem);
  Record record;
  const std::string why = why_skipped(problem, method);
  record.conclude(why.empty() ? Verdict{Status::crashed, "the case did not run"}
                              : Verdict{Status::skipped, why});
  record.case_name = planned.name().text();
  record.mesh = mesh_name_of(problem);
  if (body != nullptr) take_over(extent_of(body->mesh), record);
  describe(method, record);
  take_over(settings, record);
  take_over(limits, record);
  record.contact_solver = settings.contact;
  record.case_number = number;
  record.study = study;
  record.points = name_of(points);
  record.knob = knob.name;
  record.knob_value = knob.value;
  if (body != nullptr) {
    record.n_phi = sizes.n_phi;
    record.n_f = sizes.n_f;
  }
  record.n_c = sizes.n_c;
  if (body == nullptr) record.contact_matrix = held<contact::Problem>(problem)->how;
  record.load_steps = body != nullptr ? 1 + std::ssize(body->later_steps) : 1;
  record.stages_left_out = Json::object();
  for (const StageDecision& decision : decide_stages(problem, method, settings.fields)) {
    if (decision.run)
      record.stages_run.push_back(decision.stage);
    else
      record.stages_left_out[decision.stage] = decision.reason;
  }
  record.scene = posed.scene_name;
  record.scene_group = posed.scene_group;
  record.scene_definition = parse_json(posed.scene_definition);
  record.mesh_file = posed.mesh_file;
  record.mesh_sha256 = posed.mesh_sha256;
  if (const auto& adapted = posed.adapted) {
    record.adapt_level = adapted->level;
    record.adapt_time_s = adapted->time_s;
    record.adapt_goal = adapted->goal;
  }
  return record;
}

}  // namespace airybench
