#include "bench/records/record.hpp"

#include "bench/records/context.hpp"

namespace airybench {

CaseName name_of(const Record& r) {
  return {r.mesh, r.scene,      r.method, r.study,
          r.knob, r.knob_value, r.stop,   unless_implied(r.contact_solver, r.stop, r.knob)};
}

std::string context_word(const Record& record, const std::string& key) {
  return context_word(record.context, key);
}

bool is_verified(const Record& record) {
  return record.strain_energy_Nmm || record.equilibrium_residual;
}

bool is_measured(const Record& record) {
  return has_answer(record.status) ||
         (record.study == "error" && record.status == Status::not_converged && is_verified(record));
}

}  // namespace airybench
