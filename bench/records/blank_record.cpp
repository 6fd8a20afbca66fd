#include "bench/records/blank_record.hpp"

namespace airybench {

Record blank_record(const Problem& problem, const Method& method, const Options& options) {
  const MeshSizes sizes = solved_sizes(problem);
  Record record;
  record.mesh = problem.mesh.name;
  record.method = method.name;
  record.threads = options.threads;
  record.stop = options.stop;
  record.study = name_of(options.study);
  record.target_error = options.target_error;
  record.n_phi = sizes.n_phi;
  record.n_f = sizes.n_f;
  record.n_c = sizes.n_c;
  record.stages = decide_stages(problem, method, options.fields);
  return record;
}

Record blank_record(const Case& planned, const Options& options) {
  Record record = blank_record(*planned.posed.problem, planned.method, options);
  identify(planned, record);
  return record;
}

void identify(const Case& planned, Record& record) {
  record.scene = planned.posed.scene_name;
  record.scene_group = planned.posed.scene_group;
  record.scene_definition = planned.posed.scene_definition;
  record.mesh_file = planned.posed.mesh_file;
  record.mesh_sha256 = planned.posed.mesh_sha256;
  record.case_number = planned.number;
  record.knob = planned.knob.name;
  record.knob_value = planned.knob.value;
  record.study = name_of(planned.study);
  record.stop = planned.stop;
}

}  // namespace airybench
