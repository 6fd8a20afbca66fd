#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/stiffness_check.hpp"
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
  Eigen::VectorXd contact, u;
  {
    const StageTimer timer(solution.times.recover_s);
    if (system.n_c() > 0) contact = condensed.D * solution.F_C - condensed.G;
    u = all_displacements(factor, contact);
    solution.displacement = displacement_field(system, u);
    solution.stress = stress_of_displacement(problem, solution.displacement);
  }
  const StageTimer timer(solution.times.check_s);
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
