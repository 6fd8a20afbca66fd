#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/direct/condition.hpp"

namespace airybench {

Solution solve_hybridized(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const HybridizedSystem system = [&] {
    const StageTimer timer(solution.times, Stage::condense);
    const OwnerScope scope(MemoryOwner::system_matrix);
    return assemble_hybridized(problem, airy.contact);
  }();
  StiffnessFactor factor;
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  const CondensedSystem condensed = factorise_and_condense(
      system.K, system.b, system.n_c, "hybridized system", control, factor, solution);
  if (control.condition)
    solution.condition_estimate = estimate_condition(system.K, [&](Eigen::Ref<Eigen::MatrixXd> X) {
      factor.cholesky.solve_in_place(X, control.deadline);
    });
  solve_condensed_contact(condensed, airy.contact, control, solution);
  Eigen::VectorXd displacement(airy.contact.size());
  {
    const StageTimer timer(solution.times, Stage::recover);
    const OwnerScope scope(MemoryOwner::answer);
    if (airy.contact.size() > 0) displacement = condensed.D * solution.F_C - condensed.G;
    solution.stress = hybridized_stress(problem, system, all_displacements(factor, displacement));
  }
  const StageTimer timer(solution.times, Stage::check);
  const OwnerScope scope(MemoryOwner::check);
  check_stiffness_answer(problem, airy.contact, condensed,
                         unbalanced_forces(problem, system, solution.stress, solution.F_C),
                         displacement, factor, control, solution);
  return solution;
}

}  // namespace airybench
