#include "solvers/two_level/rows_check.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/load_scale.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

constexpr double safety = 1.5;

struct Correction {
  Eigen::VectorXd x;
  double norm = 0;  // ‖x‖_K, and what is left of it
  int iterations = 0;
};

Correction solve_under(const SlotSystem& slots, const std::vector<PointLaw>& laws,
                       Eigen::VectorXd load, TwoLevelPreconditioner& M, const Deadline& deadline) {
  const GmresOptions digits{.tolerance = 0.02, .most_iterations = 20, .threads = slots.K.threads};
  LinearisedContact linearised(slots, M);
  linearised.set(laws);
  Correction correction;
  const GmresResult linear = linearised.solve(std::move(load), digits, deadline, correction.x);
  Eigen::VectorXd Kx;
  slots.K.multiply(correction.x, Kx);
  correction.norm = std::sqrt(std::max(0.0, correction.x.dot(Kx))) +
                    two_level_condition * linear.reduction * linear.norm;
  correction.iterations = linear.iterations;
  return correction;
}

// √(F·M⁻¹F) ≤ ‖F‖_D.
double norm_from_below(const SlotSystem& slots, const Eigen::VectorXd& F_C,
                       TwoLevelPreconditioner& M) {
  const int m = slots.contact.components;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(slots.K.slots()), z;
  for (int p = 0; p < slots.contact.count; ++p) F.segment(slots.slot[p], m) = F_C.segment(m * p, m);
  M.apply(F, z);
  return std::sqrt(std::max(0.0, F.dot(z)));
}

}  // namespace

void check_rows_answer(const Problem& problem, const SlotSystem& slots, const EdgeUnknowns& unknown,
                       const UnbalancedForces& unbalanced, const std::vector<PointLaw>& laws,
                       const Eigen::VectorXd& compliance, TwoLevelPreconditioner& M,
                       const RunControl& control, Solution& solution) {
  const LoadScale scale = load_scale(problem);
  Eigen::VectorXd load = to_slots(slots.K, unknown, unbalanced.r);
  double norm_under_laws, squared;
  {  // its vectors go before the next solve
    const Eigen::VectorXd d = to_slots(slots.K, unknown, unbalanced.defect);
    load += d;
    const Correction under_laws = solve_under(slots, laws, load, M, control.deadline);
    *solution.linear_iterations += under_laws.iterations;
    norm_under_laws = under_laws.norm;
    squared =
        unbalanced.defect_energy + norm_under_laws * norm_under_laws - 2 * under_laws.x.dot(d);
  }
  const double stress =
      safety * std::sqrt(std::max(0.0, squared)) + 0.01 * std::sqrt(unbalanced.defect_energy);
  double estimate = std::max(
      relative_error(unbalanced.r.lpNorm<Eigen::Infinity>(), unbalanced.largest, scale.force_N),
      relative_error(stress, std::sqrt(stress_norm_squared(problem, solution.stress)),
                     scale.energy_norm));
  if (slots.contact.count > 0) {
    const std::vector<PointLaw> open(laws.size());
    const Correction held = solve_under(slots, open, std::move(load), M, control.deadline);
    *solution.linear_iterations += held.iterations;
    const Eigen::VectorXd u_C = solution.contact_displacement + slots.of_contact(held.x);
    const double map = natural_map(slots.contact, compliance, solution.F_C, u_C).norm();
    estimate = std::max({estimate,
                         relative_error(safety * (norm_under_laws + held.norm),
                                        norm_from_below(slots, solution.F_C, M), scale.energy_norm),
                         relative_error(map, solution.F_C.norm(), scale.force_N)});
  }
  judge_by_own_estimate(estimate, control, solution);
}

}  // namespace airybench
