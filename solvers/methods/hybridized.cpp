// HYBRID: hybridized equilibrium elements, multifrontal Cholesky. HYBRID:CHOLMOD, HYBRID:MUMPS: the
// same K by a library's factor.
#include "solvers/condensation/hybridized.hpp"

#include "solvers/base/method.hpp"
#include "solvers/condensation/finish.hpp"
#include "solvers/condensation/library_stiffness.hpp"
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
      problem, airy.contact, control, body.condensed, *body.factor,
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

// A factor that reads the elements' matrices, or one that has K put together and needs them no
// more; bytes: of what it is given.
struct GivenMatrix {
  std::unique_ptr<StiffnessFactor> factor;
  std::size_t bytes = 0;
};
using Give = GivenMatrix (*)(HybridizedSystem& system, bool keep_elements);

GivenMatrix as_elements(HybridizedSystem& system, bool) {
  return {std::make_unique<MultifrontalStiffness>(system.K, system.n_c), 0};
}

template <typename LibraryFactor>
GivenMatrix put_together(HybridizedSystem& system, bool keep_elements) {
  auto factor = std::make_unique<LibraryFactor>(system.K, system.n_c);
  const std::size_t bytes = factor->matrix_bytes();
  if (!keep_elements) system.K = {};
  return {std::move(factor), bytes};
}

Solution solve_hybridized(const DualSystem& airy, const RunControl& control, Give give) {
  const auto body = std::make_shared<HybridizedBody>();
  HybridizedSystem& system = body->system;
  Solution solution;
  const std::size_t matrix_bytes =
      run_stage(solution.times, Stage::condense, MemoryOwner::system_matrix, [&] {
        system = assemble_hybridized(*airy.problem, airy.contact);
        GivenMatrix given = give(system, control.keep_body || control.condition);
        body->factor = std::move(given.factor);
        return given.bytes;
      });
  solution.storage[MemoryOwner::system_matrix] = system.bytes() + matrix_bytes;
  body->condensed =
      factorise_and_condense(*body->factor, system.b, "hybridized system", control, solution);
  if (control.condition)
    solution.condition_estimate = estimate_condition(
        lower_triangle(system.K),
        [&](Eigen::Ref<Eigen::MatrixXd> X) { body->factor->solve_in_place(X, control.deadline); });
  finish_hybridized(airy, control, *body, solution);
  keep_if_told(airy, control, body, finish_hybridized, solution);
  return solution;
}

Method hybrid_method(const char* name, const char* summary, Give give) {
  return {
      .name = name,
      .family = "HYBRID",
      .summary = summary,
      .blocks = Blocks::contact_points,
      .solve = [give](const DualSystem& airy,
                      const RunControl& control) { return solve_hybridized(airy, control, give); },
      .knob = AccuracyKnob::contact_sweeps};
}

}  // namespace

Method hybrid() {
  return hybrid_method(
      "HYBRID",
      "hybridized equilibrium elements, multifrontal Cholesky; the reference of all errors",
      as_elements);
}

Method hybrid_cholmod() {
  return hybrid_method("HYBRID:CHOLMOD", "HYBRID's matrix by CHOLMOD's supernodal Cholesky",
                       put_together<CholmodStiffness>);
}

Method hybrid_mumps() {
  return hybrid_method("HYBRID:MUMPS", "HYBRID's matrix by MUMPS, D from its Schur complement",
                       put_together<MumpsStiffness>);
}

}  // namespace airybench
