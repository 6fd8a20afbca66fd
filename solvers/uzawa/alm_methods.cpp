#include "solvers/uzawa/alm_methods.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace airybench {
namespace {

UzawaOptions options_of(const RunControl& control) {
  UzawaOptions options;
  options.stop = control.stop;
  options.tolerance = control.tolerance;
  options.most_iterations = control.uzawa_iterations;
  return options;
}

std::string describe(double r, double rho) {
  std::ostringstream text;
  text << "r=" << r << ", rho=" << rho;
  return text.str();
}

std::string residuals(const UzawaResult& result) {
  std::ostringstream text;
  text << "i_C " << result.primal_N << " N, relative residuals " << result.primal << " and "
       << result.dual << " after " << result.iterations << " iterations";
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

}  // namespace

Solution solve_augmented_lagrangian(const DualSystem& system, const RunControl& control, double r,
                                    double rho) {
  Solution solution;
  const AugmentedFactor augmented = [&] {
    const StageTimer timer(solution.times.factor_s);
    return factor_augmented(system, r, control.deadline);
  }();
  solution.storage_bytes = augmented.factor.bytes();
  const UzawaOptions options = options_of(control);
  UzawaResult result = [&] {
    // Without contact the iteration only finds the multipliers of the prescribed forces.
    const StageTimer timer(system.n_c() > 0 ? solution.times.contact_s : solution.times.recover_s);
    return iterate_uzawa(system, augmented, {rho}, options, false, control.deadline).front();
  }();
  const StageTimer timer(solution.times.recover_s);
  solution.parameters = describe(r, rho);
  solution.uzawa_iterations = result.iterations;
  solution.F_C = std::move(result.F_C);
  solution.phi = airy_function(system, result.x);
  solution.stress = stress_of_airy_function(*system.problem, solution.phi);
  if (control.histories)
    solution.histories.push_back({control.stop == Stop::paper
                                      ? "i_C of the Uzawa iteration, N"
                                      : "relative residual of the Uzawa iteration",
                                  std::move(result.history)});
  if (result.outcome == UzawaOutcome::converged) {
    solution.status = Status::ok;
    solution.message.clear();
  } else {
    solution.status = Status::not_converged;
    solution.message = "Uzawa iteration (" + solution.parameters + ") " +
                       (result.outcome == UzawaOutcome::diverged ? "diverged: " : "too slow: ") +
                       residuals(result);
  }
  return solution;
}

Tuning tune_augmented_lagrangian(const DualSystem& system, const RunControl& control) {
  constexpr std::array<double, 8> grid = {1, 20, 40, 60, 80, 100, 200, 300};
  // From the ones that are often best, so that the others can be given up early.
  constexpr std::array<double, 8> order = {20, 40, 60, 80, 100, 1, 200, 300};
  UzawaOptions options = options_of(control);
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
    if (best != nullptr) options.most_iterations = best->iterations;  // more cannot win
  }
  if (best == nullptr)
    throw Breakdown("no combination of the grid of r and rho converges within " +
                    std::to_string(options.most_iterations) + " iterations");
  tuning.parameters = describe(best->r, best->rho);
  tuning.solve = [r = best->r, rho = best->rho](const DualSystem& s, const RunControl& c) {
    return solve_augmented_lagrangian(s, c, r, rho);
  };
  return tuning;
}

}  // namespace airybench
