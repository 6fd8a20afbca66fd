#include "bench/plan/blank_record.hpp"

#include <iterator>

#include "bench/plan/stages.hpp"

namespace airybench {
namespace {

// How bodies are told apart.
void note(const Mesh& mesh, Record& record) {
  const MeshExtent extent = extent_of(mesh);
  record.area_mm2 = extent.area_mm2;
  record.contact_length_mm = extent.contact_length_mm;
  record.width_mm = extent.width_mm;
  record.height_mm = extent.height_mm;
}

}  // namespace

void describe(const Method& method, Record& record) {
  record.method = method.name;
  record.general_name = method.identity();
  record.family = method.family;
  record.preconditioner = method.preconditioner;
  record.program = method.program;
  record.iterative = method.is_iterative();
  record.in_paper = method.in_paper;
  record.in_displacements = method.in_displacements;
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
  if (body != nullptr) note(body->mesh, record);
  describe(method, record);
  record.threads = options.threads;
  record.precision = options.precision;
  record.retry_noisy = options.retry_noisy;
  record.tuning_budget_s = options.tuning_budget_s;
  record.stop = options.stop;
  record.study = name_of(options.study);
  record.target_error = options.target_error;
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
  record.study = name_of(planned.study);
  record.stop = planned.stop;
  record.contact_solver = planned.contact;
}

}  // namespace airybench
