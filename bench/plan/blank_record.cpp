#include "bench/plan/blank_record.hpp"

#include <iterator>

#include "bench/plan/stages.hpp"

namespace airybench {

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
  record.study = options.study.name;
  if (body != nullptr) {
    record.n_phi = sizes.n_phi;
    record.n_f = sizes.n_f;
  }
  record.n_c = sizes.n_c;
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
