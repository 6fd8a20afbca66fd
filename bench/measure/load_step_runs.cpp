#include "bench/measure/load_step_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>

#include "mesh/boundary_sides.hpp"
#include "solvers/active_sets/active_set_solve.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/methods.hpp"
#include "support/seconds_since.hpp"
#include "verify/contact_intervals.hpp"

namespace airybench {
namespace {

constexpr std::tuple sums = {&Solution::factor_flops, &Solution::linear_iterations,
                             &Solution::contact_iterations, &Solution::newton_steps,
                             &Solution::uzawa_iterations};
constexpr std::tuple maxima = {&Solution::factor_entries, &Solution::error_estimate,
                               &Solution::condition_estimate};

template <typename Members, typename Each>
void for_each(const Members& members, Each each) {
  std::apply([&](const auto&... member) { (each(member), ...); }, members);
}

template <typename T>
void add(const std::optional<T>& more, std::optional<T>& sum) {
  if (more) sum = sum.value_or(0) + *more;
}

// NaN is the largest, and stays.
template <typename T>
bool is_larger(T value, T largest) {
  return !(value <= largest) && !std::isnan(static_cast<double>(largest));
}

template <typename T>
void raise(const std::optional<T>& other, std::optional<T>& largest) {
  if (other && (!largest || is_larger(*other, *largest))) largest = other;
}

void take_step(bool is_first, const std::string& prefix, const Solution& step, Solution& path) {
  add_times(step.times, path.times);
  for (const MemoryOwner owner : all_memory_owners)
    path.storage[owner] = std::max(path.storage[owner], step.storage[owner]);
  path.file_bytes = std::max(path.file_bytes, step.file_bytes);
  if (step.program) {
    const ProgramRun before = path.program.value_or(ProgramRun{});
    path.program = step.program;
    path.program->wall_s += before.wall_s;
    path.program->processor_s += before.processor_s;
    path.program->solve_s += before.solve_s;
    path.program->not_solve_s += before.not_solve_s;
    path.program->peak_bytes = std::max(step.program->peak_bytes, before.peak_bytes);
  }
  for_each(sums, [&](auto member) { add(step.*member, path.*member); });
  for_each(maxima, [&](auto member) { raise(step.*member, path.*member); });
  if (path.parameters.empty()) path.parameters = step.parameters;
  if (is_first || path.status == Status::ok || !has_answer(step.status)) {
    path.status = step.status;
    path.message = step.message.empty() ? "" : prefix + step.message;
  }
}

void hand_over(Solution& path, Solution& last) {
  last.status = path.status;
  last.message = std::move(path.message);
  last.times = path.times;
  last.storage = path.storage;
  last.file_bytes = path.file_bytes;
  last.parameters = std::move(path.parameters);
  last.program = std::move(path.program);
  for_each(std::tuple_cat(sums, maxima), [&](auto member) { last.*member = path.*member; });
}

// Of many contact points by D alone the contact law takes minutes; HYBRID goes another way.
Eigen::VectorXd first_forces(const ContactSystem& system, const Eigen::VectorXd& start) {
  if (start.size() > 0 || !system.contact.free.is_empty() || !active_sets_cost_less_than_D(system))
    return start;
  return run(select_methods(hybrid_of_degree(system.degree)).front(), system, {}).F_C;
}

}  // namespace

void add_times(const StageTimes& more, StageTimes& sum) {
  for (const Stage stage : all_stages) add(more[stage], sum[stage]);
}

Solution answer_of(const Reference& reference) {
  Solution answer;
  answer.status = Status::ok;
  answer.message.clear();
  answer.F_C = reference.F_C;
  answer.free_motion_mm = reference.free_motion_mm;
  answer.stress = reference.stress;
  if (reference.F_C.size() > 0)
    answer.contact_displacement =
        times(reference.condensed.D, reference.F_C) - reference.condensed.G;
  return answer;
}

ReferencePath references_along(const std::shared_ptr<const Problem>& first, int degree,
                               double error_at_most) {
  ReferencePath path;
  const Solve solve = [&](const ContactSystem& system, const RunControl& control) {
    path.steps.push_back(compute_reference(system, first_forces(system, control.contact.start)));
    const double estimate = path.steps.back().error_estimate;
    Solution answer = answer_of(path.steps.back());
    const double residual = *verify(system, answer, nullptr).equilibrium_residual;
    if (!(residual <= error_at_most && estimate <= error_at_most))
      throw Breakdown(fmt::format(
          "no reference: by its own estimate its error is {:.1e}, its equilibrium residual {:.1e}",
          estimate, residual));
    return answer;
  };
  ContactSystem system = contact_system(first, degree);
  solve_load_steps(solve, system, {}, [&](int step, const ContactSystem&, const Solution& answer) {
    if (has_answer(answer.status)) return;
    path.missing =
        step_prefix(step, *first) +
        (answer.status == Status::out_of_memory ? "no reference: out of memory" : answer.message);
  });
  if (!path.missing.empty()) path.steps.clear();
  return path;
}

Solution solve_path(const Solve& solve, ContactSystem& system, const RunControl& control,
                    const VisitStep& visit, double& watched_s) {
  watched_s = 0;
  if (system.problem->later_steps.empty()) return solve_load_case(solve, system, control);
  const std::shared_ptr<const Problem> first = system.problem;
  Solution path;
  int before_last = 0;
  Solution last = solve_load_steps(
      solve, system, control, [&](int step, const ContactSystem& posed, const Solution& answer) {
        before_last = step;
        take_step(step == 0, step_prefix(step, *first), answer, path);
        if (!visit) return;
        const auto start = std::chrono::steady_clock::now();
        visit(step, posed, answer);
        watched_s += seconds_since(start);
      });
  hand_over(path, last);
  if (last.done_fraction)
    last.done_fraction = (before_last + *last.done_fraction) / count_of_steps(*first);
  return last;
}

std::optional<double> largest_pressure_MPa(const ContactSystem& system, const Solution& answer) {
  if (system.contact.count == 0 || answer.as<Displacements>() != nullptr) return {};
  const Problem& problem = *system.problem;
  return largest_pressure(problem, answer.stress,
                          std::vector<bool>(problem.mesh.boundary.size(), true),
                          boundary_sides(problem.edges))
      .pressure_MPa;
}

std::string step_prefix(std::int64_t step, const Problem& first) {
  const int count = count_of_steps(first);
  return count == 1 ? "" : fmt::format("load step {} of {}: ", step + 1, count);
}

std::size_t worst_step(const std::vector<JudgedStep>& steps) {
  std::size_t worst = 0;
  double largest = worst_measure(steps.front().seen()).value;
  for (std::size_t k = 1; k < steps.size(); ++k)
    if (const double value = worst_measure(steps[k].seen()).value; is_larger(value, largest)) {
      worst = k;
      largest = value;
    }
  return worst;
}

std::vector<StepResult> step_results(const std::vector<JudgedStep>& steps) {
  std::vector<StepResult> list;
  for (const JudgedStep& step : steps) {
    const Verification& v = step.seen();
    list.push_back({.claimed_status = step.claimed_status,
                    .error = worst_measure(v).value,
                    .error_stress = v.error_stress,
                    .normal_resultant_N = v.normal_resultant_N,
                    .tangential_resultant_N = v.tangential_resultant_N,
                    .largest_pressure_MPa = step.largest_pressure_MPa,
                    .n_open = v.n_open,
                    .n_stick = v.n_stick,
                    .n_slip = v.n_slip,
                    .strain_energy_Nmm = v.strain_energy_Nmm,
                    .dissipation_Nmm = step.dissipation_Nmm,
                    .of_mesh = {},
                    .fields = step.fields});
  }
  return list;
}

int changes_of_supports(const Problem& first) {
  int changes = 0;
  const Loads* before = &first.loads;
  for (const Loads& step : first.later_steps) {
    changes += same_supports(first, *before, step) ? 0 : 1;
    before = &step;
  }
  return changes;
}

FinerPath path_in_parts(const Problem& first, int degree, int halvings) {
  constexpr double max_time_s = 300;
  Problem finer = first;
  for (int i = 0; i < halvings; ++i) finer = with_half_steps(finer);
  const int parts = 1 << halvings;
  FinerPath path;
  std::vector<JudgedStep> steps;
  Status status = Status::ok;
  double work_Nmm = 0;
  RunControl control;
  control.deadline = Deadline::after(max_time_s);
  solve_load_steps(select_methods(hybrid_of_degree(degree)).front(),
                   std::make_shared<const Problem>(std::move(finer)), control,
                   [&](int part, const ContactSystem& posed, const Solution& answer) {
                     if (!has_answer(answer.status)) return;
                     if (part % parts == 0) {
                       status = Status::ok;
                       work_Nmm = 0;
                     }
                     if (status == Status::ok) status = answer.status;
                     work_Nmm += dissipation_Nmm(posed, answer);
                     if (part % parts != parts - 1) return;
                     steps.push_back({.claimed_status = status,
                                      .verification = verify(posed, answer, nullptr),
                                      .dissipation_Nmm = work_Nmm,
                                      .largest_pressure_MPa = largest_pressure_MPa(posed, answer)});
                     path.stress = answer.stress;
                   });
  path.steps = step_results(steps);
  return path;
}

}  // namespace airybench
