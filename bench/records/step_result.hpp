// What came of a load step, an entry of Record::steps. An empty value is not known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "support/status.hpp"

namespace airybench {

// Of the step's mesh, as the fields of the same names in record_fields.def.
struct StepMeshError {
  std::optional<double> error_discretisation, lower_bound_Nmm, upper_bound_Nmm,
      normal_resultant_low_N, normal_resultant_high_N, tangential_resultant_low_N,
      tangential_resultant_high_N;
  bool operator==(const StepMeshError&) const = default;
};

struct StepResult {
  std::optional<Status> claimed_status;  // the method's
  std::optional<double> error;           // the verifier's worst measure
  std::optional<double> error_stress, normal_resultant_N, tangential_resultant_N;
  std::optional<double> largest_pressure_MPa;  // of equilibrium stresses
  std::optional<std::int64_t> n_open, n_stick, n_slip;
  std::optional<double> strain_energy_Nmm, dissipation_Nmm;
  StepMeshError of_mesh;
  std::string fields;  // what is in the step's files: "body", "contact"
  bool operator==(const StepResult&) const = default;
};

// visit("error", step.error), …: with the keys of its JSON, in their order.
template <typename Step, typename Visit>
void visit_values(Step& step, const Visit& visit) {
  visit("claimed_status", step.claimed_status);
  visit("error", step.error);
  visit("error_stress", step.error_stress);
  visit("normal_resultant_N", step.normal_resultant_N);
  visit("tangential_resultant_N", step.tangential_resultant_N);
  visit("largest_pressure_MPa", step.largest_pressure_MPa);
  visit("n_open", step.n_open);
  visit("n_stick", step.n_stick);
  visit("n_slip", step.n_slip);
  visit("strain_energy_Nmm", step.strain_energy_Nmm);
  visit("dissipation_Nmm", step.dissipation_Nmm);
  auto& mesh = step.of_mesh;
  visit("lower_bound_Nmm", mesh.lower_bound_Nmm);
  visit("upper_bound_Nmm", mesh.upper_bound_Nmm);
  visit("normal_resultant_low_N", mesh.normal_resultant_low_N);
  visit("normal_resultant_high_N", mesh.normal_resultant_high_N);
  visit("tangential_resultant_low_N", mesh.tangential_resultant_low_N);
  visit("tangential_resultant_high_N", mesh.tangential_resultant_high_N);
  visit("error_discretisation", mesh.error_discretisation);
  visit("fields", step.fields);
}

}  // namespace airybench
