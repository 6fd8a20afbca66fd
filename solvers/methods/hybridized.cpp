// HYBRID: hybridized equilibrium elements, multifrontal Cholesky.
#include "solvers/condensation/hybridized.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/condensation/stiffness_body.hpp"
#include "solvers/direct/condition.hpp"

namespace airybench {
namespace {

using HybridizedBody = StiffnessBody<HybridizedSystem>;

void finish_hybridized(const DualSystem& airy, const RunControl& control, HybridizedBody& body,
                       Solution& solution) {
  const Problem& problem = *airy.problem;
  HybridizedAnswer answer;
  finish_in_displacements(
      problem, airy.contact, control, body.condensed, body.factor,
      [&](const Eigen::VectorXd& u) {
        answer = recover_stresses(problem, body.system, u);
        solution.stress = std::move(answer.stress);
        solution.edge_moments =
            edge_moments(problem, body.system.unknown, body.system.displacement, u);
      },
      [&] {
        answer.unbalanced.r.tail(body.system.n_c) += solution.F_C;
        return std::move(answer.unbalanced);
      },
      solution);
}

Solution solve_hybridized(const DualSystem& airy, const RunControl& control) {
  const auto body = std::make_shared<HybridizedBody>();
  HybridizedSystem& system = body->system;
  Solution solution;
  system = run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix,
                     [&] { return assemble_hybridized(*airy.problem, airy.contact); });
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  body->condensed = factorise_and_condense(system.K, system.b, system.n_c, "hybridized system",
                                           control, body->factor, solution);
  if (control.condition)
    solution.condition_estimate =
        estimate_condition(lower_triangle(system.K), [&](Eigen::Ref<Eigen::MatrixXd> X) {
          body->factor.cholesky.solve_in_place(X, control.deadline);
        });
  finish_hybridized(airy, control, *body, solution);
  keep_if_told(airy, control, body, finish_hybridized, solution);
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
