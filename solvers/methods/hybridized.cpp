// HYBRID: hybridized equilibrium elements, multifrontal Cholesky.
#include "solvers/condensation/hybridized.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/direct/condition.hpp"

namespace airybench {
namespace {

Solution solve_hybridized(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const HybridizedSystem system =
      run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix,
                [&] { return assemble_hybridized(problem, airy.contact); });
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  StiffnessFactor factor;
  const CondensedSystem condensed = factorise_and_condense(
      system.K, system.b, system.n_c, "hybridized system", control, factor, solution);
  if (control.condition)
    solution.condition_estimate =
        estimate_condition(lower_triangle(system.K), [&](Eigen::Ref<Eigen::MatrixXd> X) {
          factor.cholesky.solve_in_place(X, control.deadline);
        });
  HybridizedAnswer answer;
  finish_in_displacements(
      problem, airy.contact, control, condensed, factor,
      [&](const Eigen::VectorXd& u) {
        answer = recover_stresses(problem, system, u);
        solution.stress = std::move(answer.stress);
        solution.edge_moments = edge_moments(problem, system.unknown, system.displacement, u);
      },
      [&] {
        answer.unbalanced.r.tail(system.n_c) += solution.F_C;
        return std::move(answer.unbalanced);
      },
      solution);
  return solution;
}

}  // namespace

Method hybrid() {
  return {.name = "HYBRID",
          .family = "HYBRID",
          .summary =
              "hybridized equilibrium elements, multifrontal Cholesky; the reference of all errors",
          .blocks = Blocks::contact_points,
          .solve = solve_hybridized,
          .knob = AccuracyKnob::contact_sweeps};
}

}  // namespace airybench
