// What a Workbench knows of the mesh's own error, and the fields that it writes with it.
#include <fmt/format.h>

#include "bench/judging/displacement_recovery.hpp"
#include "bench/measuring/field_files.hpp"
#include "bench/measuring/record_notes.hpp"
#include "bench/measuring/workbench.hpp"

namespace airybench {

std::optional<Workbench::Bound> Workbench::bound_for(const Method& method) const {
  if (method.in_displacements && !method.program.empty()) return {};  // its own are at hand
  if (options_.study == Study::error || method.in_displacements) return Workbench::Bound::p2;
  if (!options_.adapt.empty() || options_.fields || options_.study == Study::adapted)
    return Workbench::Bound::recovery;
  return {};
}

const Workbench::Discretisation* Workbench::discretisation(Bound bound) {
  const auto [found, is_new] = discretisation_.try_emplace(bound);
  if (is_new && problem_->later_steps.empty() && reference() != nullptr &&
      left_out_.discretisation.empty())
    found->second = compute_discretisation(bound);
  return found->second ? &*found->second : nullptr;
}

std::optional<Workbench::Discretisation> Workbench::compute_discretisation(Bound bound) {
  const ActivityScope scope(board_, Activity::discretisation);
  const DualSystem system = assemble(problem_, Blocks::contact_points);
  const char* method = bound == Bound::p2 ? "P2" : options_.adapt_by.c_str();
  const Solution own = run(select_methods(method).front(), system, {});
  if (own.status != Status::ok) return {};
  Discretisation result;
  if (bound == Bound::p2) {
    const auto& [stress, F_C] = std::tie(reference()->stress, reference()->F_C);
    result.u = own.displacement;
    result.error = constitutive_error(system, stress, F_C, result.u);
    if (result.error.flaw.empty()) return result;
    // Its law is at its nodes, at a corner of two walls about their mean normal: that goes through
    // what stands out between them.
    DisplacementField behind = admissible_displacement(system, F_C, own.displacement);
    ConstitutiveError error = constitutive_error(system, stress, F_C, behind);
    if (error.flaw.empty()) {
      result.u = std::move(behind);
      result.error = std::move(error);
    }
    return result;
  }
  result.u = recovered_displacement(system, own.stress, own.F_C, own.edge_moments);
  result.error = constitutive_error(system, own.stress, own.F_C, result.u);
  if (result.error.flaw.empty())
    result.intervals = contact_intervals(system, own.stress, own.F_C, result.u, result.error);
  return result;
}

void Workbench::note_error_of_displacement(const Solution& solution, Record& record) {
  if (reference() == nullptr) {
    record.status = has_answer(record.status) ? Status::inaccurate : record.status;
    record.status_reason = "its error is not known: " + no_reference_;
    return;
  }
  const DualSystem system = assemble(problem_, Blocks::contact_points);
  const auto& [stress, F_C] = std::tie(reference()->stress, reference()->F_C);
  note(constitutive_error(system, stress, F_C,
                          admissible_displacement(system, F_C, solution.displacement)),
       "its own displacements", record);
}

void Workbench::note_discretisation(const Method& method, const Solution& solution,
                                    Record& record) {
  if (method.in_displacements && solution.program)
    return note_error_of_displacement(solution, record);
  const std::optional<Bound> bound = bound_for(method);
  const Discretisation* known = bound ? discretisation(*bound) : nullptr;
  if (record.other_solution)
    record.no_discretisation_error = "it is known for the reference's solution only";
  else if (known != nullptr)
    note(known->error, *bound == Bound::p2 ? "P2" : "recovery", record);
  else if (method.in_displacements)
    record.no_discretisation_error =
        no_reference_.empty() ? "it is not made for load steps" : no_reference_;
  if (known != nullptr && known->intervals && !record.other_solution)
    note(*known->intervals, record);
  judge_discretisation(method, record);
}

void Workbench::judge_discretisation(const Method& method, Record& record) {
  if (record.status != Status::ok) return;
  if (record.error_discretisation.value_or(0) > 1) {
    record.status = Status::inaccurate;
    record.status_reason = fmt::format("its total error is {:.0f} %: nothing of it is known",
                                       100 * *record.error_discretisation);
  } else if (method.in_displacements && !record.error_discretisation &&
             record.status_reason.empty()) {
    record.status_reason = "its total error is not known: " + record.no_discretisation_error;
  }
}

std::optional<DisplacementField> Workbench::displacement_of(const DualSystem& system,
                                                            const Solution& solution,
                                                            const Discretisation* known) {
  std::optional<DisplacementField> w;
  if (solution.displacement.cols() > 0)
    w = solution.displacement;
  else if (solution.edge_moments.cols() > 0)
    w = recovered_displacement(system, solution.stress, solution.F_C, solution.edge_moments);
  else if (known != nullptr)
    w = known->u;
  return w && w->allFinite() ? w : std::nullopt;
}

void Workbench::write_fields_of(const Method& method, const DualSystem& system,
                                const Solution& solution, const Record& record,
                                const std::filesystem::path& file) {
  const std::optional<Bound> bound = bound_for(method);
  const Discretisation* known = bound && !record.other_solution ? discretisation(*bound) : nullptr;
  SolvedFields fields{system, solution, displacement_of(system, solution, known), nullptr, {}};
  if (known != nullptr && known->error.flaw.empty()) {
    fields.error = &known->error;
    if (options_.mean_fields) fields.mean = mean_stress(*problem_, solution.stress, known->u);
  }
  write_fields(file.parent_path(), file.filename(), fields);
}

}  // namespace airybench
