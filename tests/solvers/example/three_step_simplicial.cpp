// 3STEPD:SIMPLICIAL: three-step condensation with Eigen's simplicial factorisation
// P S Pᵀ = L D Lᵀ, P from AMD. S is symmetric positive definite.
#include <Eigen/SparseCholesky>

#include "solvers/base/method.hpp"
#include "solvers/condensation/three_step.hpp"

namespace airybench {

static Solution solve_three_step_simplicial(const AirySystem& system, const RunControl& control) {
  Solution solution;
  Eigen::SimplicialLDLT<SparseColumns> ldlt;
  run_stage(solution.times, Stage::order, MemoryOwner::factor,
            [&] { ldlt.analyzePattern(system.S); });
  control.deadline.check("the simplicial factorisation");
  run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] { ldlt.factorize(system.S); });
  if (ldlt.info() != Eigen::Success) throw Breakdown("simplicial LDLT: a pivot is zero");
  solution.factor_entries = ldlt.matrixL().nestedExpression().nonZeros() + system.n();
  solution.storage[MemoryOwner::factor] = *solution.factor_entries * (sizeof(double) + sizeof(int));

  const auto solve_S = [&](Eigen::Ref<Eigen::MatrixXd> X) {
    for (auto column : X.colwise()) {
      column = ldlt.solve(column).eval();
      control.deadline.check("the simplicial solves");
    }
  };
  solve_in_three_steps(system, control, solve_S, {}, Refine::no, solution);
  return solution;
}

Method three_step_simplicial() {
  return {.name = "3STEPD:SIMPLICIAL",
          .family = "3STEPD",
          .summary = "three-step condensation, Eigen's simplicial LDLT",
          .solve = on_airy_system(solve_three_step_simplicial)};
}

}  // namespace airybench
