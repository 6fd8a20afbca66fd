// BLIND: blind condensation with MUMPS, a solve per contact force, or D from the Schur complement
// that MUMPS leaves. BLIND:SKY: with the skyline LDLᵀ factorisation, multipliers numbered so that
// it needs no pivoting.
#include "solvers/condensation/blind.hpp"
#include "solvers/base/method.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {
namespace {

// M₁₁ and its factor; the last `trailing` unknowns are left to the Schur complement.
BlindSystem factorise(const DualSystem& system, const RunControl& control, int trailing,
                      MumpsFactor& factor, Solution& solution) {
  BlindSystem blind = run_stage(solution.times, Stage::order, MemoryOwner::system_matrix, [&] {
    return make_blind_system(system, BlindNumbering::multipliers_last);
  });
  run_stage(solution.times, Stage::order, MemoryOwner::factor,
            [&] { factor.analyse(blind.lower, trailing); });
  control.deadline.check("MUMPS's analysis");
  run_stage(solution.times, Stage::factor, MemoryOwner::factor,
            [&] { factor.factor(blind.lower); });
  control.deadline.check("MUMPS's factorisation");
  check_inertia(factor.negative_pivots(), system.n_f() + system.n_c() - trailing);
  solution.storage[MemoryOwner::system_matrix] = blind.bytes();
  count_factor(factor, solution);
  return blind;
}

Solution solve_blind_mumps(const DualSystem& system, const RunControl& control) {
  Solution solution;
  MumpsFactor factor;
  const BlindSystem blind = factorise(system, control, 0, factor, solution);
  solve_blindly(
      system, control, blind,
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
  if (n_c > 0)
    condensed = run_stage(solution.times, Stage::condense, MemoryOwner::condensed,
                          [&] { return condense_blindly(factor.schur(), factor.reduce(load)); });
  finish_in_airy_function(
      system, control, condensed,
      [&](const Eigen::VectorXd& F_C) {
        Eigen::VectorXd x = load;
        if (n_c > 0)
          x = factor.expand(condensed.G - condensed.D * F_C);
        else
          factor.solve_in_place(x, control.deadline);
        return by_blocks(system, blind, x);
      },
      [&](SaddleVector& v) {
        Eigen::VectorXd x = in_one(system, blind, v);
        if (n_c > 0)
          x = factor.expand(-condensed.D * factor.reduce(x));
        else
          factor.solve_in_place(x, control.deadline);
        v = by_blocks(system, blind, x);
      },
      refine, solution);
  return solution;
}

Solution solve_blind_skyline(const DualSystem& system, const RunControl& control) {
  Solution solution;
  const BlindSystem blind = run_stage(
      solution.times, Stage::order, MemoryOwner::system_matrix,
      [&] { return make_blind_system(system, BlindNumbering::multipliers_after_unknowns); });
  const SkylineFactor factor = factor_in_stages(blind.lower, control, solution);
  check_inertia(static_cast<int>((factor.diagonal.array() < 0).count()),
                system.n_f() + system.n_c());
  solution.storage[MemoryOwner::system_matrix] = blind.bytes();
  solve_blindly(
      system, control, blind,
      [&](Eigen::Ref<Eigen::MatrixXd> X) {
        solve_in_place(factor, X, control.deadline, control.threads);
      },
      skyline_columns_at_once * control.threads, solution);
  return solution;
}

Method blind_method(const char* name, const char* summary, Solve solve) {
  return {.name = name,
          .family = "BLIND",
          .summary = summary,
          .condenses_contact_only = true,
          .solve = std::move(solve)};
}

Method blind_schur_method(const char* name, const char* summary, Refine refine) {
  return blind_method(name, summary, [refine](const DualSystem& system, const RunControl& control) {
    return solve_blind_mumps_schur(system, control, refine);
  });
}

}  // namespace

Method blind() {
  Method method =
      blind_method("BLIND", "blind condensation, MUMPS indefinite LDLT", solve_blind_mumps);
  method.in_paper = true;
  return method;
}

Method blind_schur() {
  return blind_schur_method("BLIND:SCHUR", "blind condensation, D from MUMPS's Schur complement",
                            Refine::no);
}

Method blind_schur_refined() {
  return blind_schur_method("BLIND:SCHUR:REFINED",
                            "BLIND:SCHUR refined with residuals in long double", Refine::yes);
}

Method blind_skyline() {
  return blind_method("BLIND:SKY",
                      "blind condensation, skyline LDLT, multipliers after their unknowns",
                      solve_blind_skyline);
}

}  // namespace airybench
