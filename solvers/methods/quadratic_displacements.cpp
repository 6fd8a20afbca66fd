// P2: quadratic displacements, factorised by CHOLMOD. Solution::F_C are forces at the control
// points: not the contact points of the system.
#include "solvers/displacement/quadratic_displacements.hpp"

#include "solvers/condensation/finish.hpp"
#include "solvers/method.hpp"

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
  Eigen::VectorXd u;
  finish_in_displacements(
      problem, system.control.law, control, condensed, factor,
      [&](Eigen::VectorXd unknowns) {
        u = std::move(unknowns);
        solution.displacement = displacement_field(system, u);
        solution.stress = stress_of_displacement(problem, solution.displacement);
      },
      [&] {
        UnbalancedForces unbalanced;
        unbalanced.r = system.b - system.K.selfadjointView<Eigen::Lower>() * u;
        unbalanced.r.tail(system.n_c()) += solution.F_C;
        const auto largest = [](const Eigen::VectorXd& v) {
          return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0;
        };
        unbalanced.largest = std::max(largest(system.b), largest(solution.F_C));
        return unbalanced;
      },
      solution);
  return solution;
}

}  // namespace

Method p2() {
  return {.name = "P2",
          .family = "P2",
          .summary = "quadratic displacements, CHOLMOD: what most users would run instead",
          .blocks = Blocks::contact_points,
          .in_displacements = true,
          .solve = solve_quadratic_displacements};
}

}  // namespace airybench
