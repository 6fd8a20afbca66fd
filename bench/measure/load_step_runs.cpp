#include "bench/measure/load_step_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "solvers/base/dense_products.hpp"
#include "solvers/methods.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

template <typename T>
void add(const std::optional<T>& more, std::optional<T>& sum) {
  if (more) sum = sum.value_or(0) + *more;
}

template <typename T>
void raise(const std::optional<T>& other, std::optional<T>& largest) {
  if (other && !(largest.value_or(*other) > *other)) largest = other;  // NaN is largest
}

// What a path has spent up to here.
class PathTotals {
 public:
  void take(const std::string& prefix, const Solution& step) {
    for (const Stage stage : all_stages) add(step.times[stage], all_.times[stage]);
    for (const MemoryOwner owner : all_memory_owners)
      all_.storage[owner] = std::max(all_.storage[owner], step.storage[owner]);
    all_.file_bytes = std::max(all_.file_bytes, step.file_bytes);
    raise(step.library_bytes, all_.library_bytes);
    raise(step.factor_entries, all_.factor_entries);
    add(step.factor_flops, all_.factor_flops);
    add(step.linear_iterations, all_.linear_iterations);
    add(step.contact_iterations, all_.contact_iterations);
    add(step.newton_steps, all_.newton_steps);
    add(step.uzawa_iterations, all_.uzawa_iterations);
    raise(step.error_estimate, all_.error_estimate);
    raise(step.condition_estimate, all_.condition_estimate);
    if (all_.parameters.empty()) all_.parameters = step.parameters;
    // A step that cannot be gone on from is the last.
    if (is_first_ || all_.status == Status::ok || !has_answer(step.status)) {
      all_.status = step.status;
      all_.message = step.message.empty() ? "" : prefix + step.message;
    }
    is_first_ = false;
  }
  void hand_over(Solution& last) {
    last.status = all_.status;
    last.message = std::move(all_.message);
    last.times = all_.times;
    last.storage = all_.storage;
    last.file_bytes = all_.file_bytes;
    last.library_bytes = all_.library_bytes;
    last.factor_entries = all_.factor_entries;
    last.factor_flops = all_.factor_flops;
    last.linear_iterations = all_.linear_iterations;
    last.contact_iterations = all_.contact_iterations;
    last.newton_steps = all_.newton_steps;
    last.uzawa_iterations = all_.uzawa_iterations;
    last.error_estimate = all_.error_estimate;
    last.condition_estimate = all_.condition_estimate;
    last.parameters = std::move(all_.parameters);
  }

 private:
  Solution all_;
  bool is_first_ = true;
};

}  // namespace

Solution answer_of(const Reference& reference) {
  Solution answer;
  answer.status = Status::ok;
  answer.message.clear();
  answer.F_C = reference.F_C;
  answer.stress = reference.stress;
  if (reference.F_C.size() > 0)
    answer.contact_displacement =
        times(reference.condensed.D, reference.F_C) - reference.condensed.G;
  return answer;
}

ReferencePath references_along(const std::shared_ptr<const Problem>& first, double error_at_most) {
  ReferencePath path;
  const Solve solve = [&](const DualSystem& system, const RunControl& control) {
    path.steps.push_back(compute_reference(system, control.start));
    const double estimate = path.steps.back().error_estimate;
    Solution answer = answer_of(path.steps.back());
    const double residual = *verify(system, answer, nullptr).equilibrium_residual;
    if (!(residual <= error_at_most && estimate <= error_at_most))
      throw Breakdown(fmt::format(
          "no reference: by its own estimate its error is {:.1e}, its equilibrium residual {:.1e}",
          estimate, residual));
    return answer;
  };
  DualSystem system = assemble(first, Blocks::contact_points);
  solve_load_steps(solve, system, {}, [&](int step, const DualSystem&, const Solution& answer) {
    if (has_answer(answer.status)) return;
    path.missing =
        step_prefix(static_cast<std::size_t>(step), *first) +
        (answer.status == Status::out_of_memory ? "no reference: out of memory" : answer.message);
  });
  if (!path.missing.empty()) path.steps.clear();
  return path;
}

Solution solve_path(const Solve& solve, DualSystem& system, const RunControl& control,
                    const VisitStep& visit, double& watched_s) {
  watched_s = 0;
  if (system.problem->later_steps.empty()) return run(solve, system, control);
  const std::shared_ptr<const Problem> first = system.problem;
  PathTotals totals;
  Solution last = solve_load_steps(
      solve, system, control, [&](int step, const DualSystem& posed, const Solution& answer) {
        totals.take(step_prefix(static_cast<std::size_t>(step), *first), answer);
        if (!visit) return;
        const auto start = std::chrono::steady_clock::now();
        visit(step, posed, answer);
        watched_s += seconds_since(start);
      });
  totals.hand_over(last);
  return last;
}

std::string step_prefix(std::size_t step, const Problem& first) {
  const int count = count_of_steps(first);
  return count == 1 ? "" : fmt::format("load step {} of {}: ", step + 1, count);
}

std::size_t worst_step(const std::vector<JudgedStep>& steps) {
  const auto error_of = [](const JudgedStep& step) { return worst_measure(step.seen()).value; };
  std::size_t worst = 0;
  double largest = error_of(steps.front());
  for (std::size_t k = 1; k < steps.size(); ++k)
    if (const double value = error_of(steps[k]); !(value <= largest)) {
      worst = k;
      largest = value;
    }
  return worst;
}

Json steps_of(const std::vector<JudgedStep>& steps) {
  const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(); };
  Json list = Json::array();
  for (const JudgedStep& step : steps) {
    const Verification& v = step.seen();
    list.push_back({{"claimed_status", name_of(step.claimed_status)},
                    {"error", worst_measure(v).value},
                    {"normal_resultant_N", or_null(v.normal_resultant_N)},
                    {"tangential_resultant_N", or_null(v.tangential_resultant_N)},
                    {"n_open", or_null(v.n_open)},
                    {"n_stick", or_null(v.n_stick)},
                    {"n_slip", or_null(v.n_slip)},
                    {"dissipation_Nmm", step.dissipation_Nmm}});
  }
  return list;
}

Json steps_in_halves(const Problem& first) {
  std::vector<JudgedStep> steps;
  Status first_half = Status::ok;
  double first_half_Nmm = 0;
  solve_load_steps(select_methods("HYBRID").front(),
                   std::make_shared<const Problem>(with_half_steps(first)), {},
                   [&](int half, const DualSystem& posed, const Solution& answer) {
                     if (!has_answer(answer.status)) return;
                     const double dissipation = dissipation_Nmm(posed, answer);
                     if (half % 2 == 0) {
                       first_half = answer.status;
                       first_half_Nmm = dissipation;
                     } else {
                       steps.push_back({first_half == Status::ok ? answer.status : first_half,
                                        verify(posed, answer, nullptr),
                                        {},
                                        first_half_Nmm + dissipation});
                     }
                   });
  return steps_of(steps);
}

}  // namespace airybench
