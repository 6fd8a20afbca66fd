// HYBRID:CG: hybridized equilibrium elements, iteratively: two levels, active sets on K itself.
#include <algorithm>
#include <cmath>
#include <memory>

#include "assembly/problem/load_scale.hpp"
#include "solvers/active_sets/rows_check.hpp"
#include "solvers/active_sets/rows_notes.hpp"
#include "solvers/base/kept_body.hpp"
#include "solvers/base/method.hpp"
#include "solvers/condensation/contact_compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/two_level/slot_rows.hpp"

namespace airybench {
namespace {

struct KrylovBody {
  HybridizedSystem system;
  EdgeMatrix matrix;
  Eigen::VectorXd compliance;  // the diagonal of D from below
  std::unique_ptr<TwoLevelPreconditioner> two_levels;
  std::size_t coarse_matrix_bytes = 0;  // gone when the two levels are there
};

void note_parameters(const CoarseDisplacements& coarse, Solution& solution) {
  solution.parameters = std::string("coarse=") +
                        (coarse.kind() == CoarseKind::linear ? "linear" : "per-edge") + ", " +
                        std::to_string(coarse.unknowns()) + " unknowns" +
                        (coarse.factor().rounded() ? ", factor rounded" : "");
}

// K is factorised nowhere: what is left of it is `matrix`, unless other loads come.
void make_two_levels(const ContactSystem& given, const RunControl& control, KrylovBody& body,
                     Solution& solution) {
  const Problem& problem = *given.problem;
  std::unique_ptr<CoarseDisplacements> coarse;
  ElementMatrices coarse_matrix;
  run_stage(solution.times, Stage::precondition, MemoryOwner::system_matrix, [&] {
    body.system = assemble_hybridized(problem, given.contact);
    body.matrix = make_edge_matrix(problem, body.system, control.threads);
    body.compliance = compliance_from_below(problem, body.system.K, given.contact);
    const OwnerScope scope(MemoryOwner::preconditioner);
    coarse = std::make_unique<CoarseDisplacements>(problem, given.contact, body.matrix,
                                                   coarse_kind_for(problem));
    coarse_matrix = coarse->galerkin(problem, body.matrix, body.system);
    if (!control.keep_body) body.system.K = {};
  });
  control.deadline.check("the assembly of the two levels");
  body.coarse_matrix_bytes = coarse_matrix.bytes();
  coarse->factorise(coarse_matrix, control.deadline, solution.times);
  coarse_matrix = {};
  count_factor(coarse->factor(), solution);
  const OwnerScope scope(MemoryOwner::preconditioner);
  body.two_levels = std::make_unique<TwoLevelPreconditioner>(body.matrix, std::move(coarse));
}

void count_storage(const KrylovBody& body, const SlotRows& slots, const RowsResult& rows,
                   Solution& solution) {
  solution.storage[MemoryOwner::system_matrix] = body.system.bytes() + body.matrix.bytes();
  solution.storage[MemoryOwner::preconditioner] =
      std::max(body.two_levels->bytes(), body.coarse_matrix_bytes);
  solution.storage[MemoryOwner::iteration] = slots.bytes() + rows.bytes;
}

void check_answer(const Problem& problem, const KrylovBody& body,
                  const UnbalancedForces& unbalanced, const std::vector<PointLaw>& laws,
                  const RunControl& control, SlotRows& slots, Solution& solution) {
  const EdgeUnknowns& unknown = body.system.unknown;
  const double estimate =
      rows_error(slots,
                 {to_slots(body.matrix, unknown, unbalanced.r), unbalanced.largest,
                  to_slots(body.matrix, unknown, unbalanced.defect), unbalanced.defect_energy},
                 {laws, solution.F_C, solution.contact_displacement, body.compliance,
                  std::sqrt(stress_norm_squared(problem, solution.stress)),
                  unbalanced.r.lpNorm<Eigen::Infinity>(), load_scale(problem)},
                 *solution.linear_iterations);
  judge_by_own_estimate(estimate, control, solution);
}

// What comes after the two levels.
void finish_iteratively(const ContactSystem& given, const RunControl& control, KrylovBody& body,
                        Solution& solution) {
  const Problem& problem = *given.problem;
  const bool has_contact = given.contact.count > 0;
  TwoLevelPreconditioner& M = *body.two_levels;
  note_parameters(M.coarse(), solution);
  M.times() = {};
  const Stage stage = has_contact ? Stage::contact : Stage::recover;
  SlotRows slots = run_stage(solution.times, stage, MemoryOwner::iteration, [&] {
    return SlotRows(problem, given.contact, body.system, body.matrix, M, control.deadline);
  });
  RowsResult rows = run_stage(solution.times, stage, MemoryOwner::iteration, [&] {
    return solve_contact_on_rows(slots, load_scale(problem),
                                 {control.tolerance, control.target_error / 1000});
  });
  note_rows(rows, given.contact, control, control.tolerance, solution);
  count_storage(body, slots, rows, solution);
  slots.drop_space();
  HybridizedAnswer answer;
  run_stage(solution.times, Stage::recover, MemoryOwner::answer, [&] {
    solution.F_C = project_on_coulomb(given.contact, rows.F_C);
    const Eigen::VectorXd u =
        from_slots(body.matrix, body.system.unknown, rows.u, body.system.b.size());
    rows.u.resize(0);
    slots.drop_loads();
    solution.contact_displacement = u.tail(body.system.n_c);
    answer = recover_stresses(problem, body.system, u);
    solution.stress = std::move(answer.stress);
    solution.unknowns =
        EdgeDisplacements{edge_moments(problem, body.system.unknown, body.system.displacement, u)};
    answer.unbalanced.r.tail(body.system.n_c) += solution.F_C;
  });
  if (rows.converged)  // else the check's own solves would not end either
    run_stage(solution.times, Stage::check, MemoryOwner::check, [&] {
      check_answer(problem, body, answer.unbalanced, rows.laws, control, slots, solution);
    });
  solution.iteration_times = M.times();
}

Solution solve_hybridized_cg(const ContactSystem& given, const RunControl& control) {
  refuse_free_bodies(given.contact);
  if (!given.contact.opposite.empty())
    throw Breakdown("bodies in contact with each other: HYBRID:CG knows walls only");
  const auto body = std::make_shared<KrylovBody>();
  Solution solution;
  make_two_levels(given, control, *body, solution);
  finish_iteratively(given, control, *body, solution);
  const auto take_loads = [](const Problem& problem, KrylovBody& kept) {
    set_load_case(problem, kept.system);
  };
  keep_if_told(given, control, body, take_loads, finish_iteratively, solution);
  return solution;
}

}  // namespace

Method hybrid_cg() {
  return {.name = "HYBRID:CG",
          .family = "HYBRID:CG",
          .summary = "hybridized equilibrium elements, two-level Krylov iteration, active sets",
          .unknowns = Unknowns::edge_displacements,
          .joins_bodies = false,
          .stages = {Stage::precondition, Stage::order, Stage::factor, Stage::contact,
                     Stage::recover, Stage::check},
          .solve = solve_hybridized_cg,
          .first_tolerance = 1e-3,
          .paper_tolerance = 1e-6,
          .knob = AccuracyKnob::krylov_tolerance};
}

}  // namespace airybench
