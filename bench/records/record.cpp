#include "bench/records/record.hpp"

#include "bench/records/context.hpp"

namespace airybench {

CaseName name_of(const Record& r) {
  return {r.mesh, r.scene, r.method, r.study, r.knob, r.knob_value, r.stop};
}

std::string context_word(const Record& record, const std::string& key) {
  return context_word(record.context, key);
}

bool has_answer(const Record& record) {
  return record.status == Status::ok || record.status == Status::inaccurate ||
         record.status == Status::unstressed;
}

bool is_verified(const Record& record) {
  return record.strain_energy_Nmm || record.equilibrium_residual;
}

bool is_measured(const Record& record) {
  return has_answer(record) ||
         (record.study == "error" && record.status == Status::not_converged && is_verified(record));
}

}  // namespace airybench
