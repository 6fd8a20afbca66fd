#include "solvers/active_sets/active_set_solve.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "assembly/problem/load_scale.hpp"
#include "solvers/active_sets/factored_rows.hpp"
#include "solvers/active_sets/rows_check.hpp"
#include "solvers/active_sets/rows_notes.hpp"
#include "solvers/base/kept_body.hpp"
#include "solvers/condensation/contact_compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"
#include "solvers/contact/paired_points.hpp"
#include "solvers/direct/elimination.hpp"

namespace airybench {
namespace {

struct ActiveSetBody {
  HybridizedSystem system;
  Eigen::VectorXd compliance;  // the diagonal of D from below
};

void finish_by_active_sets(const ContactSystem& given, const RunControl& control,
                           ActiveSetBody& body, Solution& solution) {
  const Problem& problem = *given.problem;
  HybridizedSystem& system = body.system;
  const double tolerance = control.contact.tolerance;
  const Stage stage = given.contact.count > 0 ? Stage::contact : Stage::recover;
  FactoredRows rows = run_stage(solution.times, stage, MemoryOwner::iteration, [&] {
    return FactoredRows(problem, given.contact, system, control.contact.start, control.deadline);
  });
  RowsResult found = run_stage(solution.times, stage, MemoryOwner::iteration, [&] {
    return solve_contact_on_rows(rows, load_scale(problem),
                                 {tolerance, control.target_error / 1000});
  });
  note_rows(found, given.contact, control, tolerance, solution);
  solution.parameters = "active sets on K";
  solution.storage[MemoryOwner::system_matrix] = system.bytes();
  HybridizedAnswer answer;
  const Eigen::VectorXd F = project_on_coulomb(rows.contact, found.F_C);
  run_stage(solution.times, Stage::recover, MemoryOwner::answer, [&] {
    answer = recover_stresses(problem, system, found.u);
    solution.F_C = at_both(given.contact, F);
    solution.contact_displacement = found.u.tail(system.n_c);
    solution.stress = std::move(answer.stress);
    solution.unknowns =
        EdgeDisplacements{edge_moments(problem, system.unknown, system.displacement, found.u)};
  });
  // Else the check's own solves would not end either.
  if (found.converged)
    run_stage(solution.times, Stage::check, MemoryOwner::check, [&] {
      answer.unbalanced.r.tail(system.n_c) += solution.F_C;
      const double largest_r = answer.unbalanced.r.lpNorm<Eigen::Infinity>();
      const double estimate = rows_error(rows, std::move(answer.unbalanced),
                                         {found.laws, F, rows.of_contact(found.u), body.compliance,
                                          std::sqrt(stress_norm_squared(problem, solution.stress)),
                                          largest_r, load_scale(problem)},
                                         *solution.linear_iterations);
      judge_by_own_estimate(estimate, control, solution);
    });
  solution.storage[MemoryOwner::iteration] = rows.bytes() + found.bytes;
  solution.storage[MemoryOwner::factor] = rows.made().bytes;
  solution.factor_entries = rows.made().entries;
  solution.factor_flops = rows.made().flops;
}

}  // namespace

bool active_sets_cost_less_than_D(const ContactSystem& given) {
  constexpr int few = 3000;
  constexpr double sets = 20;
  const double n_c = given.contact.size();
  if (n_c <= few) return false;
  const Problem& problem = *given.problem;
  EdgeUnknowns unknown;
  const int inner = number_unknowns(problem, given.contact, unknown);
  ElementMatrices K(3 * unknown.length());  // without entries
  K.order = inner + given.contact.size();
  std::vector<int> numbers;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    element_unknowns(problem, unknown, t, numbers);
    K.unknown.push_back(numbers.data());
    K.centre.push_back(centre_of(problem.vertices_of(t)));
  }
  return n_c * n_c * n_c > sets * analyse_elimination(K, 0).flops();
}

Solution solve_by_active_sets(const ContactSystem& given, const RunControl& control) {
  refuse_free_bodies(given.contact);
  const auto body = std::make_shared<ActiveSetBody>();
  Solution solution;
  run_stage(solution.times, Stage::precondition, MemoryOwner::system_matrix, [&] {
    body->system = assemble_hybridized(*given.problem, given.contact);
    body->compliance = of_both(
        given.contact, compliance_from_below(*given.problem, body->system.K, given.contact));
  });
  finish_by_active_sets(given, control, *body, solution);
  const auto take_loads = [](const Problem& problem, ActiveSetBody& kept) {
    set_load_case(problem, kept.system);
  };
  keep_if_told(given, control, body, take_loads, finish_by_active_sets, solution);
  return solution;
}

}  // namespace airybench
