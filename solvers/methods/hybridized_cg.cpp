// HYBRID:CG: hybridized equilibrium elements, iteratively: two levels, active sets on K itself.
#include <cmath>
#include <sstream>

#include "assembly/load_scale.hpp"
#include "solvers/base/method.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {
namespace {

struct KrylovBody {
  HybridizedSystem system;
  EdgeMatrix matrix;
};

void note_rows(const RowsResult& rows, const RunControl& control, Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  solution.linear_iterations = rows.iterations;
  solution.F_C = rows.F_C;
  if (control.histories)
    solution.histories.push_back({"relative error of the linear system per step", rows.history});
  if (rows.converged) return;
  std::ostringstream message;
  message << "active sets on the hybridized matrix: natural map residual "
          << rows.natural_map_residual << ", linear error " << rows.linear_error << " after "
          << rows.steps << " active sets and " << rows.iterations
          << " linear iterations (tolerance " << control.tolerance << ")";
  solution.status = Status::not_converged;
  solution.message = message.str();
}

// The energy that an answer may be off by, from the forces that its stresses leave: under the laws
// found (the error to first order), and with F_C held.
void check(const Problem& problem, const SlotSystem& slots, TwoLevelPreconditioner& M,
           const EdgeUnknowns& unknown, const HybridizedAnswer& answer, const RowsResult& rows,
           const RunControl& control, Solution& solution) {
  constexpr GmresOptions digits{0.02, 0, 20};
  constexpr double safety = 1.5;  // of an energy norm with a digit and a half
  const LoadScale scale = load_scale(problem);
  const UnbalancedForces& left = answer.unbalanced;
  const Eigen::VectorXd defect = to_slots(slots.K, unknown, left.defect),
                        load = to_slots(slots.K, unknown, left.r) + defect;
  LinearisedContact linearised(slots, M);
  Eigen::VectorXd x, Kx;
  const auto energy_of = [&](const std::vector<PointLaw>& laws) {
    linearised.set(laws);
    *solution.linear_iterations += linearised.solve(load, digits, control.deadline, x).iterations;
    slots.K.multiply(x, Kx);
    return x.dot(Kx);
  };
  const double under_laws = energy_of(rows.laws);
  const double squared = left.defect_energy + under_laws - 2 * x.dot(defect);
  const double error =
      safety * std::sqrt(std::max({0.0, squared})) + 0.01 * std::sqrt(left.defect_energy);
  double estimate = relative_error(left.r.lpNorm<Eigen::Infinity>(), left.largest, scale.force_N);
  estimate = std::max(
      estimate, relative_error(error, std::sqrt(stress_norm_squared(problem, solution.stress)),
                               scale.energy_norm));
  if (slots.contact.count > 0) {
    const double held = energy_of(std::vector<PointLaw>(rows.laws.size()));
    const Eigen::VectorXd u_C = solution.contact_displacement + slots.of_contact(x);
    Eigen::VectorXd F = Eigen::VectorXd::Zero(slots.K.slots()), of_F;
    const int m = slots.contact.components;
    for (int p = 0; p < slots.contact.count; ++p)
      F.segment(slots.slot[p], m) = solution.F_C.segment(m * p, m);
    M.apply(F, of_F);  // K ≤ M: from below
    const double of_forces = std::sqrt(std::max(0.0, F.dot(of_F)));
    const double forces_off =
        safety * (std::sqrt(std::max(0.0, under_laws)) + std::sqrt(std::max(0.0, held)));
    const double off = natural_map(slots.contact, slots.compliance, solution.F_C, u_C).norm();
    estimate = std::max({estimate, relative_error(forces_off, of_forces, scale.energy_norm),
                         relative_error(2 * off, solution.F_C.norm(), scale.force_N)});
  }
  judge_by_own_estimate(estimate, control, solution);
}

Solution solve_hybridized_cg(const DualSystem& airy, const RunControl& control) {
  const Problem& problem = *airy.problem;
  Solution solution;
  KrylovBody body;
  const CoarseKind kind = coarse_kind_for(problem);
  std::unique_ptr<CoarseDisplacements> coarse;
  run_stage(solution.times, Stage::precondition, MemoryOwner::system_matrix, [&] {
    body.system = assemble_hybridized(problem, airy.contact);
    body.matrix = make_edge_matrix(problem, body.system);
    coarse = std::make_unique<CoarseDisplacements>(problem, airy.contact, body.matrix, kind);
  });
  control.deadline.check("the assembly of the hybridized system");
  coarse->factorise(problem, body.system, body.matrix, control.deadline, solution.times);
  count_factor(coarse->factor(), solution);
  body.system.K = {};  // `matrix` has it
  TwoLevelPreconditioner M(body.matrix, std::move(coarse));
  const SlotSystem slots(problem, airy.contact, body.system, body.matrix);
  solution.storage[MemoryOwner::system_matrix] = body.system.bytes() + body.matrix.bytes();
  std::ostringstream parameters;
  parameters << "coarse=" << (kind == CoarseKind::linear ? "linear" : "per-edge") << ", "
             << M.coarse().unknowns() << " unknowns";
  solution.parameters = parameters.str();

  const bool has_contact = airy.contact.count > 0;
  const RowsResult rows = run_stage(
      solution.times, has_contact ? Stage::contact : Stage::recover, MemoryOwner::iteration,
      [&] { return solve_contact_on_rows(slots, M, load_scale(problem).energy_norm, control); });
  note_rows(rows, control, solution);
  if (has_contact) {
    solution.contact_iterations = rows.sweeps;
    solution.newton_steps = rows.steps;
  }
  solution.storage[MemoryOwner::preconditioner] = M.bytes();
  HybridizedAnswer answer;
  run_stage(solution.times, Stage::recover, MemoryOwner::answer, [&] {
    solution.F_C = project_on_coulomb(airy.contact, solution.F_C);
    const Eigen::VectorXd u =
        from_slots(body.matrix, body.system.unknown, rows.u, body.system.b.size());
    solution.contact_displacement = u.tail(body.system.n_c);
    answer = recover_stresses(problem, body.system, u);
    solution.stress = std::move(answer.stress);
    solution.edge_moments = edge_moments(problem, body.system.unknown, body.system.displacement, u);
    answer.unbalanced.r.tail(body.system.n_c) += solution.F_C;
  });
  run_stage(solution.times, Stage::check, MemoryOwner::check, [&] {
    check(problem, slots, M, body.system.unknown, answer, rows, control, solution);
  });
  return solution;
}

}  // namespace

Method hybrid_cg() {
  return {.name = "HYBRID:CG",
          .family = "HYBRID:CG",
          .summary = "hybridized equilibrium elements, two-level Krylov iteration, active sets",
          .blocks = Blocks::contact_points,
          .stages = {Stage::precondition, Stage::order, Stage::factor, Stage::contact,
                     Stage::recover, Stage::check},
          .solve = solve_hybridized_cg,
          .first_tolerance = 1e-2,
          .paper_tolerance = 1e-6,
          .knob = AccuracyKnob::krylov_tolerance};
}

}  // namespace airybench
