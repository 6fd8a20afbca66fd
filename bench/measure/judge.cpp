#include "bench/measure/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "assembly/problem/load_scale.hpp"
#include "bench/measure/remarks.hpp"
#include "solvers/active_sets/active_set_solve.hpp"
#include "verify/geometry_error.hpp"

namespace airybench {
namespace {

std::vector<double> errors_of_method(const std::vector<JudgedStep>& steps) {
  std::vector<double> errors;
  for (const JudgedStep& step : steps) errors.push_back(step.seen().error_stress.value_or(0));
  return errors;
}

}  // namespace

Judge::Judge(const PosedProblem& problem, const CaseSettings& common, const LeftOut& left_out)
    : problem_(held<Problem>(problem)),
      contact_problem_(held<contact::Problem>(problem)),
      common_(common),
      discretisation_left_out_(left_out.discretisation) {
  no_references_ = problem_ ? left_out.reference : "a problem without a body";
}

void Judge::prepare(const Method& method) {
  reference(method.degree);
  if (const auto bound = bound_for(method)) discretisation(*bound, method.degree);
  finer_path(method.degree);
}

std::string Judge::too_large_for_reference(int degree) const {
  if (mesh_sizes(problem_->mesh).n_phi > largest_with_reference)
    return fmt::format("no reference above n_phi = {}", largest_with_reference);
  if (has_too_many_contact_points(degree))
    return fmt::format("no reference above n_c = {}", max_contact_unknowns_of_D);
  return "";
}
bool Judge::has_too_many_contact_points(int degree) const {
  return contact_points(*problem_, degree).size() > max_contact_unknowns_of_D;
}

const ReferencePath& Judge::references(int degree) {
  const auto [found, is_new] = references_.try_emplace(degree);
  ReferencePath& path = found->second;
  if (!is_new) return path;
  path.missing = no_references_;
  if (path.missing.empty()) path.missing = too_large_for_reference(degree);
  if (!path.missing.empty()) return path;
  const ActivityScope scope(board_, Activity::reference);
  try {
    path = references_along(problem_, degree, reference_error_at_most());
  } catch (const std::bad_alloc&) {
    path.missing = "no reference: out of memory";
  }
  return path;
}

const Reference* Judge::reference(int degree, int step) {
  const ReferencePath& path = references(degree);
  return path.steps.empty() ? nullptr : &path.steps[static_cast<std::size_t>(step)];
}

bool Judge::is_answered(const Solution& solution) const {
  return problem_ ? !solution.stress.empty() : solution.F_C.size() > 0;
}

JudgedStep Judge::judged(const std::vector<JudgedStep>& before, const ContactSystem& system,
                         const Solution& solution) {
  const ActivityScope scope(board_, Activity::verification);
  const int step = static_cast<int>(before.size());
  JudgedStep result = {.claimed_status = solution.status,
                       .verification = verify(system, solution, reference(system.degree, step)),
                       .dissipation_Nmm = dissipation_Nmm(system, solution),
                       .largest_pressure_MPa = largest_pressure_MPa(system, solution)};
  const auto* const displacements = solution.as<Displacements>();
  if (displacements == nullptr) {
    double start_off_N = 0;
    for (const JudgedStep& one : before) start_off_N += one.verification.slip_off_N;
    result.as_other = verify_as_other_solution(system, solution, result.verification, start_off_N);
  } else if (displacements->by_program) {
    // A zero stress from the program does not prove that the body has none, nor the reference's
    // that the program's is right.
    const double energy_norm = std::sqrt(2 * result.verification.strain_energy_Nmm);
    result.verification.unstressed =
        reference(1, step) != nullptr && reference(1, step)->stress.values().isZero(0) &&
        energy_norm <= common_.target_error * load_scale(*system.problem).energy_norm;
    result.displacement = displacements->w;
  }
  return result;
}

JudgedStep Judge::judged(const ContactSystem* system, const Solution& solution) {
  if (problem_) return judged({}, *system, solution);
  const ActivityScope scope(board_, Activity::verification);
  return {solution.status, verify(*contact_problem_, solution.F_C)};
}

std::optional<Verification> Judge::verify_as_other_solution(const ContactSystem& system,
                                                            const Solution& solution,
                                                            const Verification& v,
                                                            double start_off_N) {
  const auto is_small = [&](double error) { return error <= common_.target_error; };
  // Only forces that meet the law with the reference's D and G, but differ from its forces.
  // A step that starts from a wrong slip meets the law of another problem.
  if (is_small(worst_measure(v).value) || !v.friction_coupling ||
      !(start_off_N <= common_.target_error * solution.F_C.norm()) ||
      !is_small(std::max(v.natural_map_residual.value_or(0), v.equilibrium_residual.value_or(0))))
    return {};
  try {
    const ContactSystem posed = contact_system(system.problem, system.degree);
    const Reference other = compute_reference(posed, solution.F_C, StartIs::solution);
    if (!(other.error_estimate <= reference_error_at_most())) return {};
    const Verification seen = verify(system, solution, &other);
    return is_small(worst_measure(seen).value) ? std::optional(seen) : std::nullopt;
  } catch (const Breakdown&) {
    return {};
  }
}

Verdict Judge::judge(const Case& asked, CaseResult& result) {
  const Method& method = asked.method;
  const Solution& solution = *result.solution;
  Verdict verdict = {solution.status, solution.message};
  const auto is_ok = [&] { return verdict.status == Status::ok; };
  if (result.search.tuning_cut && !is_ok()) verdict.add("the search was cut: see tuning_cut");
  if (!is_answered(solution)) return verdict;
  result.verification = result.steps.back().seen();
  if (is_ok()) verdict = judge_method_error(asked, std::move(verdict), result);
  const auto* const displacements = solution.as<Displacements>();
  const bool is_by_program = displacements != nullptr && displacements->by_program;
  const bool has_other_elements = is_by_program && displacements->by_program->other_elements;
  if (is_ok() && is_by_program && !has_other_elements)
    verdict = judge_penetration(result.steps, displacements->by_program->allowed_penetration,
                                std::move(verdict));
  if (!problem_) return verdict;
  const bool of_displacements = method.in_displacements() && !is_by_program;
  result.polygons = polygon_groups(*problem_, method.degree + (of_displacements ? 1 : 0));
  if (is_by_program && reference(1) == nullptr)
    return {has_answer(verdict.status) ? Status::inaccurate : verdict.status,
            "its error is not known: " + references(1).missing};
  result.of_mesh = is_by_program ? total_error_of_program(result.steps)
                                 : discretisation_error(method, result.is_other_solution);
  result.of_mesh.total.set_method_errors(errors_of_method(result.steps));
  const FinerPath* const finer = finer_path(method.degree);
  const bool is_path = count_of_steps(*problem_) > 1;
  if (finer != nullptr && is_path) result.steps_in_halves = finer->steps;
  if (finer != nullptr && !is_path) take_eight_steps(*finer, method, result);
  if (is_ok()) {
    verdict = judge_total_error(method, std::move(verdict), result);
    result.is_right_on_the_mesh = !is_ok();
  }
  if (is_ok() && has_other_elements)
    verdict.add(
        "judged by its total error alone: its elements are not the quadratic ones of the mesh");
  if (is_ok()) verdict.add(remark_on_polygons(method, result.polygons, result.of_mesh.total));
  if (is_ok() && finer != nullptr && is_path && !method.in_displacements())
    for (const std::string& remark : remarks_on_half_steps(step_results(result.steps), finer->steps,
                                                           changes_of_supports(*problem_)))
      verdict.add(remark);
  return verdict;
}

void Judge::take_eight_steps(const FinerPath& path, const Method& method,
                             CaseResult& result) const {
  if (path.steps.empty() || path.steps.back().claimed_status != Status::ok ||
      method.in_displacements())
    return;
  result.in_eight_steps = path.steps;
  result.change_in_eight_steps = stress_distance(*problem_, result.solution->stress, path.stress) /
                                 std::sqrt(stress_norm_squared(*problem_, path.stress));
}

Verdict Judge::judge_penetration(const std::vector<JudgedStep>& steps, double allowed,
                                 Verdict so_far) const {
  const auto worst = std::ranges::max_element(
      steps, {}, [](const JudgedStep& step) { return step.seen().penetration_share.value_or(0); });
  const Verification& v = worst->seen();
  if (!(v.penetration_share > allowed)) return so_far;
  return {
      Status::inaccurate,
      fmt::format(
          "{}penetrates the {} by {:.2g} mm, {:.3g} % of the largest displacement; allowed {:g} %",
          prefix_of(worst - steps.begin()), obstacle_of(*problem_), *v.penetration_mm,
          100 * *v.penetration_share, 100 * allowed)};
}

Verdict Judge::judge_method_error(const Case& asked, Verdict so_far, CaseResult& result) {
  const Method& method = asked.method;
  const std::vector<JudgedStep>& steps = result.steps;
  const Solution& solution = *result.solution;
  const Verification& v = steps.back().seen();
  // A path may end unloaded.
  const bool is_unstressed =
      std::ranges::all_of(steps, [](const JudgedStep& step) { return step.seen().unstressed; });
  const std::size_t at = worst_step(steps);
  const WorstMeasure worst = worst_measure(steps[at].seen());
  const auto other =
      std::ranges::find_if(steps, [](const JudgedStep& step) { return step.as_other.has_value(); });
  const double target = asked.settings.target_error;
  if (!(worst.value <= target))
    return {Status::inaccurate,
            fmt::format("{}{} {:.2e} is above the target {:.0e}",
                        prefix_of(static_cast<std::int64_t>(at)), worst.name, worst.value, target)};
  if (other != steps.end()) {
    result.is_other_solution = true;
    return {Status::ok, fmt::format("{}another solution than the reference's, {:.1e} of its stress "
                                    "away; errors are to this one",
                                    prefix_of(other - steps.begin()),
                                    other->verification.error_stress.value_or(0))};
  }
  if (v.stress_of_moments_off && solution.error_estimate &&
      !too_large_for_reference(method.degree).empty())
    return {Status::ok,
            fmt::format("{}: its error, {:.1e}, is its own estimate only; equilibrium, contact law "
                        "and that its stresses are those of its displacements are checked",
                        references(method.degree).missing, *solution.error_estimate)};
  if (!v.error_stress && !method.in_displacements() && problem_)
    return {Status::inaccurate, "its error is not known: " + references(method.degree).missing};
  if (is_unstressed)
    return {Status::unstressed, method.in_displacements()
                                    ? "its displacements have no stress: nothing touches or loads "
                                      "what is free of them"
                                    : "the body has no stress: nothing touches or loads it" +
                                          words_of_least_gap(*problem_)};
  if (problem_) {
    for (const std::string& remark : remarks_on_what_is_idle(*problem_, v)) so_far.add(remark);
    so_far.add(remark_on_large_strains(*problem_, solution.stress));
  }
  return so_far;
}

}  // namespace airybench
