#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/direct/condition.hpp"

namespace airybench {

Solution solve_hybridized(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const HybridizedSystem system = [&] {
    const StageTimer timer(solution.times.condense_s);
    return assemble_hybridized(problem, airy.contact);
  }();
  StiffnessFactor factor;
  {
    const StageTimer timer(solution.times.order_s);
    factor.cholesky.analyse(system.K, system.n_c);
  }
  control.deadline.check("the ordering of the hybridized system");
  {
    const StageTimer timer(solution.times.factor_s);
    factor.cholesky.factor(system.K);
  }
  control.deadline.check("the factorisation of the hybridized system");
  if (control.condition)
    solution.condition_estimate = estimate_condition(system.K, [&](Eigen::Ref<Eigen::MatrixXd> X) {
      factor.cholesky.solve_in_place(X, control.deadline);
    });
  CondensedSystem condensed;
  {
    const StageTimer timer(solution.times.condense_s);
    factor.y = factor.cholesky.forward(system.b);
    condensed = condense(factor);
  }
  solution.storage_bytes = system.bytes() + factor.cholesky.bytes() +
                           static_cast<std::size_t>(condensed.D.size()) * sizeof(double);
  solve_condensed_contact(condensed, airy.contact, control, solution);
  Eigen::VectorXd displacement(airy.contact.size());
  {
    const StageTimer timer(solution.times.recover_s);
    if (airy.contact.size() > 0) displacement = condensed.D * solution.F_C - condensed.G;
    solution.stress = hybridized_stress(problem, system, all_displacements(factor, displacement));
  }
  const StageTimer timer(solution.times.check_s);
  check_stiffness_answer(problem, airy.contact, condensed,
                         unbalanced_forces(problem, system, solution.stress, solution.F_C),
                         displacement, factor, control, solution);
  return solution;
}

}  // namespace airybench
