// P2, P3, P4: displacements of that degree, multifrontal Cholesky. Solution::F_C are forces at the
// control points: not the contact points of the system.
#include "solvers/displacement/displacement_system.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/condensation/stiffness_body.hpp"

namespace airybench {
namespace {

using DisplacementBody = StiffnessBody<DisplacementSystem>;

void finish_displacements(const ContactSystem& given, const RunControl& control,
                          DisplacementBody& body, Solution& solution) {
  const Problem& problem = *given.problem;
  body.condensed.points = body.system.control.law;  // the load case's
  finish_in_displacements(
      problem, control, body.condensed, *body.factor,
      [&](const Eigen::VectorXd& unknowns) {
        DisplacementField w = displacement_field(problem, body.system, unknowns);
        solution.stress = own_stress(problem, w);
        solution.unknowns = Displacements{std::move(w)};
      },
      [&] {
        const NodalForces forces =
            nodal_forces(problem, std::get<Displacements>(solution.unknowns).w);
        return UnbalancedForces{
            unbalanced_forces(problem, body.system, forces, solution.F_C), forces.largest, {}, 0};
      },
      solution);
}

Solution solve_displacements(const ContactSystem& given, const RunControl& control) {
  const auto body = std::make_shared<DisplacementBody>();
  DisplacementSystem& system = body->system;
  Solution solution;
  system = run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix, [&] {
    return assemble_displacement_system(*given.problem, given.degree + 1);
  });
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  body->factor = std::make_unique<MultifrontalStiffness>(system.K, system.n_c());
  body->condensed = factorise_and_condense(*body->factor, system.b, system.control.law,
                                           "displacement system", control.deadline, solution);
  finish_displacements(given, control, *body, solution);
  keep_if_told(given, control, body, finish_displacements, solution);
  return solution;
}

// The system has stresses of degree p − 1.
Method displacement_method(int degree, const char* summary) {
  const std::string name = "P" + std::to_string(degree);
  return {.name = name,
          .family = name,
          .summary = summary,
          .unknowns = Unknowns::displacements,
          .degree = degree - 1,
          .solve = solve_displacements};
}

}  // namespace

Method p2() {
  return displacement_method(
      2, "quadratic displacements, multifrontal Cholesky: what most users would run instead");
}
Method p3() { return displacement_method(3, "P2 with displacements of degree 3"); }
Method p4() { return displacement_method(4, "P2 with displacements of degree 4"); }

}  // namespace airybench
