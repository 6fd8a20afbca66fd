#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/displacement/quadratic_displacements.hpp"

namespace airybench {

Solution solve_quadratic_displacements(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const QuadraticDisplacements system = [&] {
    const StageTimer timer(solution.times.condense_s);
    return assemble_quadratic_displacements(problem);
  }();
  StiffnessFactor factor;
  {
    const StageTimer timer(solution.times.order_s);
    factor.cholesky.analyse(system.K, system.n_c());
  }
  control.deadline.check("the ordering of the displacement system");
  {
    const StageTimer timer(solution.times.factor_s);
    factor.cholesky.factor(system.K);
  }
  control.deadline.check("the factorisation of the displacement system");
  CondensedSystem condensed;
  {
    const StageTimer timer(solution.times.condense_s);
    factor.y = factor.cholesky.forward(system.b);
    condensed = condense(factor);
  }
  solution.storage_bytes = system.bytes() + factor.cholesky.bytes() +
                           static_cast<std::size_t>(condensed.D.size()) * sizeof(double);
  solve_condensed_contact(condensed, system.control.law, control, solution);
  const StageTimer timer(solution.times.recover_s);
  Eigen::VectorXd contact;
  if (system.n_c() > 0) contact = condensed.D * solution.F_C - condensed.G;
  solution.displacement = displacement_field(system, all_displacements(factor, contact));
  solution.stress = stress_of_displacement(problem, solution.displacement);
  return solution;
}

}  // namespace airybench
