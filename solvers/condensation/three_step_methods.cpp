#include <sstream>

#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/condition.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/krylov/conjugate_gradients.hpp"

namespace airybench {
namespace {

// Everything after the factorisation of S, or after its preconditioner.
void condense_and_solve(const DualSystem& system, const RunControl& control, const KeepX& keep,
                        Refine refine, const SolveInPlace& solve_S, Solution& solution) {
  ThreeStep steps;
  {
    const StageTimer timer(solution.times, Stage::condense);
    steps = condense_in_three_steps(system, solve_S, keep);
  }
  solution.storage[MemoryOwner::intermediate] = steps.bytes();
  solution.storage[MemoryOwner::condensed] = steps.condensed.bytes();
  solution.file_bytes = steps.X.bytes() - steps.X.heap_bytes();
  solve_condensed_contact(steps.condensed, system.contact, control, solution);
  SaddleVector answer;
  {
    const StageTimer timer(solution.times, Stage::recover);
    answer = recover_airy_unknowns(steps, system, solution.F_C, solve_S);
    const OwnerScope scope(MemoryOwner::answer);
    solution.phi = airy_function(system, answer.x);
    solution.stress = stress_of_airy_function(*system.problem, solution.phi);
  }
  finish_airy_answer(
      refine, system, steps.condensed.D,
      [&](SaddleVector& v) { solve_saddle(steps, system, solve_S, v); }, answer, control, solution);
}

}  // namespace

Solution solve_three_step_skyline(const DualSystem& system, const RunControl& control,
                                  KeepX::Where where, Refine refine) {
  Solution solution;
  SkylineProfile profile;
  {
    const StageTimer timer(solution.times, Stage::order);
    const OwnerScope scope(MemoryOwner::factor);
    profile = analyse_skyline(system.S);
  }
  SkylineFactor factor;
  {
    const StageTimer timer(solution.times, Stage::factor);
    const OwnerScope scope(MemoryOwner::factor);
    factor = factor_ldlt(std::move(profile), system.S, control.deadline);
  }
  count_factor(factor, solution);
  const auto solve_S = [&](Eigen::Ref<Eigen::MatrixXd> X) {
    solve_in_place(factor, X, control.deadline, control.threads);
  };
  if (control.condition) solution.condition_estimate = estimate_condition(system.S, solve_S);
  condense_and_solve(system, control, {where, skyline_columns_at_once * control.threads}, refine,
                     solve_S, solution);
  return solution;
}

Solution solve_three_step_cholmod(const DualSystem& system, const RunControl& control) {
  Solution solution;
  CholmodFactor factor;
  {
    const StageTimer timer(solution.times, Stage::order);
    factor.analyse(system.S);
  }
  {
    const StageTimer timer(solution.times, Stage::factor);
    factor.factor(system.S);
  }
  const auto solve_S = [&](Eigen::Ref<Eigen::MatrixXd> X) {
    factor.solve_in_place(X, control.deadline);
  };
  if (control.condition) solution.condition_estimate = estimate_condition(system.S, solve_S);
  condense_and_solve(system, control, {}, Refine::no, solve_S, solution);
  count_factor(factor, solution);
  return solution;
}

Solution solve_three_step_cg(const DualSystem& system, const RunControl& control,
                             const MakePreconditioner& make, int lanes, Refine refine) {
  Solution solution;
  const Preconditioner preconditioner = [&] {
    const StageTimer timer(solution.times, Stage::precondition);
    const OwnerScope scope(MemoryOwner::preconditioner);
    return make(system.S, control.deadline);
  }();
  note_preconditioner(preconditioner, solution);
  const KrylovOptions options = krylov_options(control, lanes);
  solution.storage[MemoryOwner::iteration] =
      iteration_bytes(options, system.n_f() + system.n_c(),
                      conjugate_gradient_vectors * system.n() + preconditioner.workspace_rows);
  KrylovSummary all;
  const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) {
    KrylovOptions used = options;
    if (X.cols() == 1) used.lanes = 1;
    try {
      all.add(solve_by_conjugate_gradients(system.S, preconditioner, columns_of(X), used,
                                           control.deadline));
    } catch (TimeoutReached& timeout) {
      if (X.cols() == 1) timeout.count_before(system.n_f() + system.n_c());  // S⁻¹ q is the last
      throw;
    }
  };
  condense_and_solve(system, control, {}, refine, solve, solution);
  note_krylov("conjugate gradients", all, options, control, solution);
  return solution;
}

}  // namespace airybench
