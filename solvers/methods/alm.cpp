// ALM: the augmented Lagrangian method with given parameters, ALM:r=…,rho=…, and with the best of
// the paper's grid.
#include "solvers/uzawa/augmented_lagrangian.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "solvers/direct/factor_counts.hpp"
#include "solvers/names/general_names.hpp"

namespace airybench {
namespace {

std::string describe(double r, double rho) {
  std::ostringstream text;
  text << "r=" << r << ", rho=" << rho;
  return text.str();
}

std::string name_of(UzawaOutcome outcome) {
  switch (outcome) {
    case UzawaOutcome::converged:
      return "converged";
    case UzawaOutcome::diverged:
      return "diverged";
    default:
      return "given up";
  }
}

Solution solve_augmented_lagrangian(const AirySystem& system, const RunControl& control, double r,
                                    double rho) {
  Solution solution;
  const AugmentedFactor augmented =
      run_stage(solution.times, Stage::factor, MemoryOwner::factor,
                [&] { return factor_augmented(system, r, control.deadline); });
  count_factor(augmented.factor, solution);
  solution.storage[MemoryOwner::iteration] = uzawa_bytes(system, 1);
  const UzawaOptions options = uzawa_options(control);
  UzawaResult result = [&] {
    // Without contact the iteration only finds the multipliers of the prescribed forces.
    const StageTimer timer(solution.times, system.n_c() > 0 ? Stage::contact : Stage::recover);
    return iterate_uzawa(system, augmented, {rho}, options, false, control.deadline).front();
  }();
  store_uzawa_answer(system, control, penalised_solve(system, augmented), describe(r, rho),
                     std::move(result), solution);
  return solution;
}

// The paper's 8 × 8 grid, [1, 20, 40, 60, 80, 100, 200, 300]² for (r, ρ): the combination that
// meets the stop in the fewest iterations. One factorisation per r; the ρ of one r run side by
// side; a combination is given up at as many iterations as the best so far needed. When time is up,
// what was found until then counts. Throws Breakdown when none converges, TimeoutReached when none
// has until then.
Tuning tune_augmented_lagrangian(const AirySystem& system, const RunControl& control) {
  constexpr std::array<double, 8> grid = {1, 20, 40, 60, 80, 100, 200, 300};
  // From the ones that are often best, so that the others can be given up early.
  constexpr std::array<double, 8> order = {20, 40, 60, 80, 100, 1, 200, 300};
  UzawaOptions options = uzawa_options(control);
  Tuning tuning;
  const GridPoint* best = nullptr;
  tuning.grid.reserve(grid.size() * grid.size());
  const std::vector<double> rhos(grid.begin(), grid.end());
  for (const double r : order) {
    if (best != nullptr && control.deadline.passed()) {  // what there is will do
      for (const double rho : rhos) tuning.grid.push_back({r, rho, 0, "not tried"});
      continue;
    }
    std::vector<UzawaResult> results;
    try {
      const AugmentedFactor augmented = factor_augmented(system, r, control.deadline);
      results = iterate_uzawa(system, augmented, rhos, options, true, control.deadline);
    } catch (const TimeoutReached&) {
      if (best == nullptr) throw;
      for (const double rho : rhos) tuning.grid.push_back({r, rho, 0, "not tried"});
      continue;
    }
    for (const UzawaResult& result : results) {
      tuning.grid.push_back({r, result.rho, result.iterations, name_of(result.outcome)});
      if (result.outcome == UzawaOutcome::converged &&
          (best == nullptr || result.iterations < best->iterations))
        best = &tuning.grid.back();
    }
    if (best != nullptr) options.max_iterations = best->iterations;  // more cannot win
  }
  if (best == nullptr)
    throw Breakdown("no combination of the grid of r and rho converges within " +
                    std::to_string(options.max_iterations) + " iterations");
  tuning.parameters = describe(best->r, best->rho);
  tuning.solve =
      on_airy_system([r = best->r, rho = best->rho](const AirySystem& s, const RunControl& c) {
        return solve_augmented_lagrangian(s, c, r, rho);
      });
  return tuning;
}

Method alm_method(const std::string& name, const std::string& summary) {
  Method method;
  method.name = name;
  method.family = "ALM";
  method.summary = "augmented Lagrangian, Uzawa's algorithm with " + summary;
  method.stages = {Stage::factor, Stage::contact, Stage::recover, Stage::check};
  method.first_tolerance = 2e-2;
  return method;
}

}  // namespace

Method alm(GeneralName name) {
  if (!name.first().empty()) name.refuse("'" + name.first() + "' is no parameter (valid: r, rho)");
  const double r = name.positive("r"), rho = name.positive("rho");
  name.refuse_rest("r, rho");
  Method method = alm_method(name.name(), "given parameters");
  method.knob = AccuracyKnob::uzawa_iterations;
  method.solve = on_airy_system([r, rho](const AirySystem& system, const RunControl& control) {
    return solve_augmented_lagrangian(system, control, r, rho);
  });
  return method;
}

Method tuned_alm() {
  Method method = alm_method("ALM", "the best of the paper's grid");
  method.in_paper = true;
  method.knob = AccuracyKnob::stop;
  method.tune = on_airy_system(tune_augmented_lagrangian);
  method.solve = on_airy_system([](const AirySystem& system, const RunControl& control) {
    return tune_augmented_lagrangian(system, control).solve(system, control);
  });
  return method;
}

}  // namespace airybench
