#include "solvers/condensation/blind.hpp"
#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/direct/condition.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {
namespace {

SaddleVector recover(const DualSystem& system, const BlindSystem& blind, const Eigen::VectorXd& x,
                     Solution& solution) {
  SaddleVector answer = by_blocks(system, blind, x);
  const OwnerScope scope(MemoryOwner::answer);
  solution.phi = airy_function(system, answer.x);
  solution.stress = stress_of_airy_function(*system.problem, solution.phi);
  return answer;
}

// Everything after the factorisation of M₁₁, by solves.
void condense_and_solve(const DualSystem& system, const BlindSystem& blind,
                        const RunControl& control, const BlindSolve& solve, int columns_at_once,
                        Solution& solution) {
  if (control.condition) solution.condition_estimate = estimate_condition(blind.lower, solve);
  CondensedSystem condensed;
  if (system.n_c() > 0) {
    const StageTimer timer(solution.times, Stage::condense);
    const OwnerScope scope(MemoryOwner::condensed);
    condensed = condense_blindly(system, blind, solve, columns_at_once);
  }
  solution.storage[MemoryOwner::condensed] = condensed.bytes();
  solve_condensed_contact(condensed, system.contact, control, solution);
  SaddleVector answer;
  {
    const StageTimer timer(solution.times, Stage::recover);
    Eigen::VectorXd x = blind_right_hand_side(system, blind, solution.F_C);
    solve(x);
    answer = recover(system, blind, x, solution);
  }
  const auto solve_saddle = [&](SaddleVector& v) {
    Eigen::VectorXd x = in_one(system, blind, v);
    solve(x);
    v = by_blocks(system, blind, x);
  };
  check_airy_answer(system, condensed.D.diagonal(), solve_saddle, answer, control, solution);
}

// Made where it stays: Eigen's sparse matrices are copied when they are assigned.
BlindSystem timed_system(const DualSystem& system, BlindNumbering numbering, Solution& solution) {
  const StageTimer timer(solution.times, Stage::order);
  return make_blind_system(system, numbering);
}

// M₁₁ and its factor; the last `trailing` unknowns are left to the Schur complement.
BlindSystem factorise(const DualSystem& system, const RunControl& control, int trailing,
                      MumpsFactor& factor, Solution& solution) {
  BlindSystem blind = timed_system(system, BlindNumbering::multipliers_last, solution);
  {
    const StageTimer timer(solution.times, Stage::order);
    factor.analyse(blind.lower, trailing);
  }
  control.deadline.check("MUMPS's analysis");
  {
    const StageTimer timer(solution.times, Stage::factor);
    factor.factor(blind.lower);
  }
  control.deadline.check("MUMPS's factorisation");
  check_inertia(factor.negative_pivots(), system.n_f() + system.n_c() - trailing);
  solution.storage[MemoryOwner::system_matrix] = blind.bytes();
  count_factor(factor, solution);
  return blind;
}

}  // namespace

Solution solve_blind_mumps(const DualSystem& system, const RunControl& control) {
  Solution solution;
  MumpsFactor factor;
  const BlindSystem blind = factorise(system, control, 0, factor, solution);
  condense_and_solve(
      system, blind, control,
      [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_in_place(X, control.deadline); },
      MumpsFactor::columns_at_once, solution);
  return solution;
}

Solution solve_blind_mumps_schur(const DualSystem& system, const RunControl& control,
                                 Refine refine) {
  const int n_c = system.n_c();
  Solution solution;
  MumpsFactor factor;
  const BlindSystem blind = factorise(system, control, n_c, factor, solution);
  const Eigen::VectorXd load = blind_right_hand_side(system, blind, {});
  CondensedSystem condensed;
  if (n_c > 0) {
    const StageTimer timer(solution.times, Stage::condense);
    const OwnerScope scope(MemoryOwner::condensed);
    condensed = condense_blindly(factor.schur(), factor.reduce(load));
  }
  solution.storage[MemoryOwner::condensed] = condensed.bytes();
  solve_condensed_contact(condensed, system.contact, control, solution);
  SaddleVector answer;
  {
    const StageTimer timer(solution.times, Stage::recover);
    Eigen::VectorXd x = load;
    if (n_c > 0)
      x = factor.expand(condensed.G - condensed.D * solution.F_C);
    else
      factor.solve_in_place(x, control.deadline);
    answer = recover(system, blind, x, solution);
  }
  const auto solve_saddle = [&](SaddleVector& v) {
    Eigen::VectorXd x = in_one(system, blind, v);
    if (n_c > 0)
      x = factor.expand(-condensed.D * factor.reduce(x));
    else
      factor.solve_in_place(x, control.deadline);
    v = by_blocks(system, blind, x);
  };
  finish_airy_answer(refine, system, condensed.D, solve_saddle, answer, control, solution);
  return solution;
}

Solution solve_blind_skyline(const DualSystem& system, const RunControl& control) {
  Solution solution;
  const BlindSystem blind =
      timed_system(system, BlindNumbering::multipliers_after_unknowns, solution);
  SkylineProfile profile;
  {
    const StageTimer timer(solution.times, Stage::order);
    const OwnerScope scope(MemoryOwner::factor);
    profile = analyse_skyline(blind.lower);
  }
  SkylineFactor factor;
  {
    const StageTimer timer(solution.times, Stage::factor);
    const OwnerScope scope(MemoryOwner::factor);
    factor = factor_ldlt(std::move(profile), blind.lower, control.deadline);
  }
  check_inertia(static_cast<int>((factor.diagonal.array() < 0).count()),
                system.n_f() + system.n_c());
  solution.storage[MemoryOwner::system_matrix] = blind.bytes();
  count_factor(factor, solution);
  condense_and_solve(
      system, blind, control,
      [&](Eigen::Ref<Eigen::MatrixXd> X) {
        solve_in_place(factor, X, control.deadline, control.threads);
      },
      skyline_columns_at_once * control.threads, solution);
  return solution;
}

}  // namespace airybench
