#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/stiffness_check.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/displacement/quadratic_displacements.hpp"

namespace airybench {

Solution solve_quadratic_displacements(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const QuadraticDisplacements system = [&] {
    const StageTimer timer(solution.times, Stage::condense);
    const OwnerScope scope(MemoryOwner::system_matrix);
    return assemble_quadratic_displacements(problem);
  }();
  StiffnessFactor factor;
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  const CondensedSystem condensed = factorise_and_condense(
      system.K, system.b, system.n_c(), "displacement system", control, factor, solution);
  solve_condensed_contact(condensed, system.control.law, control, solution);
  Eigen::VectorXd contact, u;
  {
    const StageTimer timer(solution.times, Stage::recover);
    if (system.n_c() > 0) contact = condensed.D * solution.F_C - condensed.G;
    u = all_displacements(factor, contact);
    const OwnerScope scope(MemoryOwner::answer);
    solution.displacement = displacement_field(system, u);
    solution.stress = stress_of_displacement(problem, solution.displacement);
  }
  const StageTimer timer(solution.times, Stage::check);
  const OwnerScope scope(MemoryOwner::check);
  UnbalancedForces unbalanced;
  unbalanced.r = system.b - system.K.selfadjointView<Eigen::Lower>() * u;
  unbalanced.r.tail(system.n_c()) += solution.F_C;
  unbalanced.largest = std::max(system.b.cwiseAbs().maxCoeff(),
                                solution.F_C.size() > 0 ? solution.F_C.cwiseAbs().maxCoeff() : 0);
  check_stiffness_answer(problem, system.control.law, condensed, unbalanced, contact, factor,
                         control, solution);
  return solution;
}

}  // namespace airybench
