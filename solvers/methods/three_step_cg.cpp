// 3STEPCG:<preconditioner>: three-step condensation with preconditioned conjugate gradients.
#include "solvers/condensation/three_step.hpp"
#include "solvers/krylov/conjugate_gradients.hpp"
#include "solvers/names/general_names.hpp"

namespace airybench {
namespace {

Solution solve_three_step_cg(const AirySystem& system, const RunControl& control,
                             const MakePreconditioner& make, Refine refine) {
  Solution solution;
  const Preconditioner preconditioner =
      run_stage(solution.times, Stage::precondition, MemoryOwner::preconditioner,
                [&] { return make(system.S, control.deadline); });
  note_preconditioner(preconditioner, solution);
  const KrylovOptions options = krylov_options(control);
  solution.storage[MemoryOwner::iteration] =
      iteration_bytes(options, system.n_f() + system.n_c(),
                      conjugate_gradient_vectors * system.n() + preconditioner.workspace_rows);
  KrylovSummary all;
  const auto solve_S = [&](Eigen::Ref<Eigen::MatrixXd> X) {
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
  solve_in_three_steps(system, control, solve_S, {}, refine, solution);
  note_krylov("conjugate gradients", all, options, control, solution);
  return solution;
}

}  // namespace

Method three_step_cg(GeneralName name) {
  const MakePreconditioner make = name.preconditioner();
  const Refine refine = name.refine();
  name.refuse_rest("refine");
  Method method = krylov_method(name, "three-step condensation, conjugate gradients with ");
  method.solve = on_airy_system([=](const AirySystem& system, const RunControl& control) {
    return solve_three_step_cg(system, control, make, refine);
  });
  return method;
}

}  // namespace airybench
