// P2: quadratic displacements, multifrontal Cholesky. Solution::F_C are forces at the control
// points: not the contact points of the system.
#include "solvers/displacement/quadratic_displacements.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/condensation/stiffness_body.hpp"

namespace airybench {
namespace {

using QuadraticBody = StiffnessBody<QuadraticDisplacements>;

void finish_quadratic(const DualSystem& airy, const RunControl& control, QuadraticBody& body,
                      Solution& solution) {
  const Problem& problem = *airy.problem;
  body.condensed.points = body.system.control.law;  // the load case's
  finish_in_displacements(
      problem, control, body.condensed, *body.factor,
      [&](const Eigen::VectorXd& unknowns) {
        solution.displacement = displacement_field(body.system, unknowns);
        solution.stress = stress_of_displacement(problem, solution.displacement);
      },
      [&] {
        const NodalForces forces = nodal_forces(problem, solution.stress);
        return UnbalancedForces{
            unbalanced_forces(problem, body.system, forces, solution.F_C), forces.largest, {}, 0};
      },
      solution);
}

Solution solve_quadratic_displacements(const DualSystem& airy, const RunControl& control) {
  const auto body = std::make_shared<QuadraticBody>();
  QuadraticDisplacements& system = body->system;
  Solution solution;
  system = run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix,
                     [&] { return assemble_quadratic_displacements(*airy.problem); });
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  body->factor = std::make_unique<MultifrontalStiffness>(system.K, system.n_c());
  body->condensed = factorise_and_condense(*body->factor, system.b, system.control.law,
                                           "displacement system", control.deadline, solution);
  finish_quadratic(airy, control, *body, solution);
  keep_if_told(airy, control, body, finish_quadratic, solution);
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
