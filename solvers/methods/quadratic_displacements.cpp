// P2: quadratic displacements, multifrontal Cholesky. Solution::F_C are forces at the control
// points: not the contact points of the system.
#include "solvers/displacement/quadratic_displacements.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"

namespace airybench {
namespace {

Solution solve_quadratic_displacements(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  const QuadraticDisplacements system =
      run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix,
                [&] { return assemble_quadratic_displacements(problem); });
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  StiffnessFactor factor;
  const CondensedSystem condensed = factorise_and_condense(
      system.K, system.b, system.n_c(), "displacement system", control, factor, solution);
  finish_in_displacements(
      problem, system.control.law, control, condensed, factor,
      [&](const Eigen::VectorXd& unknowns) {
        solution.displacement = displacement_field(system, unknowns);
        solution.stress = stress_of_displacement(problem, solution.displacement);
      },
      [&] {
        const NodalForces forces = nodal_forces(problem, solution.stress);
        return UnbalancedForces{
            unbalanced_forces(problem, system, forces, solution.F_C), forces.largest, {}, 0};
      },
      solution);
  return solution;
}

}  // namespace

Method p2() {
  return {.name = "P2",
          .family = "P2",
          .summary =
              "quadratic displacements, multifrontal Cholesky: what most users would run instead",
          .blocks = Blocks::contact_points,
          .in_displacements = true,
          .solve = solve_quadratic_displacements};
}

}  // namespace airybench
