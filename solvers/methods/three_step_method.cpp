// 3STEPD: three-step condensation with the skyline LDLᵀ factorisation, right-hand sides in
// parallel; refined, or with the intermediate matrices in a file or nowhere. 3STEPD:CHOLMOD: with
// CHOLMOD's supernodal Cholesky factorisation.
#include "solvers/base/method.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/cholmod.hpp"
#include "solvers/direct/condition.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/direct/skyline.hpp"

namespace airybench {
namespace {

Solution solve_with_skyline(const AirySystem& system, const RunControl& control, KeepX::Where where,
                            Refine refine) {
  Solution solution;
  const auto factor =
      std::make_shared<const SkylineFactor>(factor_in_stages(system.S, control.deadline, solution));
  const auto solve_S = [own = factor.get(), deadline = control.deadline,
                        threads = control.threads](Eigen::Ref<Eigen::MatrixXd> X) {
    solve_in_place(*own, X, deadline, threads);
  };
  if (control.condition) solution.condition_estimate = estimate_condition(system.S, solve_S);
  solve_in_three_steps(system, control, solve_S, {where, skyline_columns_at_once * control.threads},
                       refine, solution, factor);
  return solution;
}

Solution solve_with_cholmod(const AirySystem& system, const RunControl& control) {
  Solution solution;
  const auto factor = std::make_shared<CholmodFactor>();
  run_stage(solution.times, Stage::order, MemoryOwner::factor, [&] { factor->analyse(system.S); });
  run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] { factor->factor(system.S); });
  const auto solve_S = [own = factor.get(), deadline = control.deadline](
                           Eigen::Ref<Eigen::MatrixXd> X) { own->solve_in_place(X, deadline); };
  if (control.condition) solution.condition_estimate = estimate_condition(system.S, solve_S);
  solve_in_three_steps(system, control, solve_S, {}, Refine::no, solution, factor);
  count_factor(*factor, solution);
  return solution;
}

Method with_skyline(const char* name, const char* summary, KeepX::Where where, Refine refine) {
  return {.name = name,
          .family = "3STEPD",
          .summary = summary,
          .solve = on_airy_system([=](const AirySystem& system, const RunControl& control) {
            return solve_with_skyline(system, control, where, refine);
          })};
}

}  // namespace

Method three_step() {
  Method method = with_skyline("3STEPD", "three-step condensation, skyline LDLT",
                               KeepX::Where::memory, Refine::no);
  method.in_paper = true;
  method.knob = AccuracyKnob::contact_sweeps;
  return method;
}

Method three_step_refined() {
  return with_skyline("3STEPD:REFINED", "3STEPD refined with residuals in extended precision",
                      KeepX::Where::memory, Refine::yes);
}

Method three_step_file() {
  return with_skyline("3STEPD:FILE", "3STEPD with the intermediate matrices in a file",
                      KeepX::Where::file, Refine::no);
}

Method three_step_lean() {
  return with_skyline("3STEPD:LEAN", "3STEPD that never stores the intermediate matrices whole",
                      KeepX::Where::nowhere, Refine::no);
}

Method three_step_cholmod() {
  return {.name = "3STEPD:CHOLMOD",
          .family = "3STEPD",
          .summary = "three-step condensation, CHOLMOD supernodal Cholesky",
          .solve = on_airy_system(solve_with_cholmod)};
}

}  // namespace airybench
