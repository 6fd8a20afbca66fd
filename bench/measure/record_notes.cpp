#include "bench/measure/record_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/records/summary.hpp"
#include "bench/verify/answer_hash.hpp"

namespace airybench {

void note(const Solution& solution, Record& record) {
  record.status = solution.status;
  record.status_reason = solution.message;
  record.claimed_status = solution.status;
  record.error_estimate = solution.error_estimate;
  record.condition_estimate = solution.condition_estimate;
  if (const std::size_t bytes = matrix_bytes(solution); bytes > 0)
    record.storage_bytes = static_cast<std::int64_t>(bytes);
  record.library_bytes = solution.library_bytes;
  record.factor_entries = solution.factor_entries;
  if (solution.factor_flops) record.factor_flops = std::llround(*solution.factor_flops);
  record.linear_iterations = solution.linear_iterations;
  record.contact_iterations = solution.contact_iterations;
  record.newton_steps = solution.newton_steps;
  record.uzawa_iterations = solution.uzawa_iterations;
  if (const auto& times = solution.iteration_times) {
    record.iteration_matrix_s = times->matrix_s;
    record.iteration_smoother_s = times->smoother_s;
    record.iteration_coarse_s = times->coarse_s;
  }
  record.parameters = solution.parameters;
}

void note(const std::vector<IterationHistory>& histories, Record& record) {
  for (const IterationHistory& history : histories)
    record.histories[history.what] = history.residual;
}

void note(const std::vector<GridPoint>& grid, Record& record) {
  for (const GridPoint& point : grid)
    record.grid.push_back({{"r", point.r},
                           {"rho", point.rho},
                           {"iterations", point.iterations},
                           {"outcome", point.outcome}});
}

void note(const Verification& v, Record& record) {
  record.error_stress = v.error_stress;
  record.error_stress_absolute = v.error_stress_absolute;
  record.reference_error = v.reference_error;
  record.friction_coupling = v.friction_coupling;
  record.error_force = v.error_force;
  record.equilibrium_residual = v.equilibrium_residual;
  record.siconos_error = v.siconos_error;
  record.natural_map_residual = v.natural_map_residual;
  record.signorini_violation_N = v.signorini_violation_N;
  record.coulomb_violation_N = v.coulomb_violation_N;
  record.normal_resultant_N = v.normal_resultant_N;
  record.tangential_resultant_N = v.tangential_resultant_N;
  record.strain_energy_Nmm = v.strain_energy_Nmm;
  record.complementary_energy_Nmm = v.complementary_energy_Nmm;
  record.n_open = v.n_open;
  record.n_stick = v.n_stick;
  record.n_slip = v.n_slip;
  record.answer_hash = answer_hash(v);
}

void note_what_is_idle(const Problem& problem, Record& record) {
  const MeshSizes sizes = mesh_sizes(problem.mesh);
  if (sizes.contact_edges + sizes.force_edges == 0) {
    record.status_reason = "the whole boundary is prescribed";
  } else if (sizes.contact_edges == 0) {
    record.status_reason = "there is no contact boundary";
  } else if (const std::int64_t points = record.n_open.value_or(0);
             points > 0 && record.n_stick.value_or(0) + record.n_slip.value_or(0) == 0) {
    record.status_reason =
        fmt::format("nothing touches the wall: all {} contact points are open", points);
  }
}

void note_slip_of_half_steps(Record& record) {
  constexpr double little = 0.01;
  const auto add = [&](const std::string& text) {
    record.status_reason += (record.status_reason.empty() ? "" : "; ") + text;
  };
  const bool all_ok = std::ranges::all_of(record.steps_in_halves, [](const Json& step) {
    return step.at("claimed_status") == name_of(Status::ok);
  });
  if (record.steps_in_halves.size() != record.steps.size() || !all_ok)
    return add("with every load step in two halves there is no answer to compare with");
  const Json &last = record.steps.back(), &halved = record.steps_in_halves.back();
  const auto resultants = [](const Json& step) {
    return Eigen::Vector2d(step.at("normal_resultant_N").get<double>(),
                           step.at("tangential_resultant_N").get<double>());
  };
  const Eigen::Vector2d F = resultants(last), F_halved = resultants(halved);
  if (last.at("n_stick") == halved.at("n_stick") && last.at("n_slip") == halved.at("n_slip") &&
      (F - F_halved).norm() <= little * F_halved.norm())
    return;
  add(fmt::format(
      "with every load step in two halves {} points stick and {} slip at the end, not {} and {}; "
      "F = ({:.5g}, {:.5g}) N, not ({:.5g}, {:.5g})",
      halved.at("n_stick").get<int>(), halved.at("n_slip").get<int>(),
      last.at("n_stick").get<int>(), last.at("n_slip").get<int>(), F_halved.x(), F_halved.y(),
      F.x(), F.y()));
}

void note_large_strains(const Problem& problem, const StressField& stress, Record& record) {
  constexpr double largest_small = 0.1;
  double largest = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    // Triangles' means: corners are singular on any mesh.
    const Eigen::Vector3d strain = problem.compliance_of(t) * stress[t].rowwise().mean();
    const double middle = (strain(0) + strain(1)) / 2,
                 radius = std::hypot((strain(0) - strain(1)) / 2, strain(2) / 2);
    largest = std::max(largest, std::abs(middle) + radius);
  }
  if (!(largest > largest_small)) return;
  record.status_reason += fmt::format(
      "{}strains of up to {:.2g} %: small strains, which all of this assumes, do not hold",
      record.status_reason.empty() ? "" : "; ", 100 * largest);
}

void note(const ConstitutiveError& error, const char* by, Record& record) {
  if (error.flaw.empty()) {
    record.error_discretisation = error.relative;
    record.discretisation_by = by;
    if (is_verified(record))
      record.error_mean = error.relative_of_mean + record.error_stress.value_or(0) / 2;
  } else {
    record.no_discretisation_error = error.flaw;
  }
  if (error.guaranteed) {
    record.lower_bound_Nmm = error.lower_bound_Nmm;
    record.upper_bound_Nmm = error.upper_bound_Nmm;
  }
}

void note(const ContactIntervals& intervals, Record& record) {
  record.intervals = intervals.guaranteed ? "guaranteed" : "estimated";
  if (const auto& normal = intervals.normal_resultant_N) {
    record.normal_resultant_low_N = normal->low;
    record.normal_resultant_high_N = normal->high;
  }
  if (const auto& tangential = intervals.tangential_resultant_N) {
    record.tangential_resultant_low_N = tangential->low;
    record.tangential_resultant_high_N = tangential->high;
  }
  record.largest_pressure_MPa = intervals.largest_pressure_MPa;
  record.largest_pressure_is = name_of(intervals.peak);
  if (const auto& within = intervals.largest_pressure_within_MPa) {
    record.largest_pressure_low_MPa = within->low;
    record.largest_pressure_high_MPa = within->high;
  }
  record.contact_ends = Json::array();
  for (const ContactEnd& end : intervals.ends)
    record.contact_ends.push_back({{"face", end.face},
                                   {"from", name_of(end.before)},
                                   {"to", name_of(end.after)},
                                   {"x_mm", end.at_mm.x()},
                                   {"y_mm", end.at_mm.y()},
                                   {"low_mm", end.along_face_mm.low},
                                   {"high_mm", end.along_face_mm.high}});
}

void note(const MemorySplit& memory, Record& record) {
  record.memory_by_owner = by_owner(memory);
  record.memory_by_stage = by_stage(memory);
  record.memory_counts_differ = counts_differ(memory);
  record.memory_count_ratio = count_ratio(memory);
  record.heap_allocations = memory.allocations;
  record.heap_allocated_bytes = memory.allocated_bytes;
}

}  // namespace airybench
