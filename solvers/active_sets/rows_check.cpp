#include "solvers/active_sets/rows_check.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

struct Correction {
  Eigen::VectorXd x;
  double norm = 0;  // ‖x‖_K, and what is left of it
};

Correction solve_under(ContactRows& rows, const std::vector<PointLaw>& laws, Eigen::VectorXd load,
                       std::int64_t& iterations) {
  const GmresOptions digits{.tolerance = 0.02, .max_iterations = 20};
  rows.set(laws);
  Correction correction;
  const GmresResult linear = rows.solve(std::move(load), digits, correction.x);
  Eigen::VectorXd Kx;
  rows.multiply(correction.x, Kx);
  correction.norm =
      std::sqrt(larger_error(0, rows.dot(correction.x, Kx))) + rows.error_left(linear, {}, false);
  iterations += linear.iterations;
  return correction;
}

}  // namespace

double rows_error(ContactRows& rows, UnbalancedForces unbalanced, const RowsAnswer& answer,
                  std::int64_t& iterations) {
  constexpr double safety = 1.5;
  const auto& [laws, F_C, u_C, compliance, stress_norm, largest_r, scale] = answer;
  Eigen::VectorXd load = std::move(unbalanced.r);
  double norm_under_laws, squared;
  {  // its vectors go before the next solve
    const Eigen::VectorXd d = std::move(unbalanced.defect);
    load += d;
    const Correction under_laws = solve_under(rows, laws, load, iterations);
    norm_under_laws = under_laws.norm;
    squared = unbalanced.defect_energy + norm_under_laws * norm_under_laws -
              2 * rows.dot(under_laws.x, d);
  }
  const double stress =
      safety * std::sqrt(larger_error(0, squared)) + 0.01 * std::sqrt(unbalanced.defect_energy);
  const double estimate = larger_error(scale.relative_force(largest_r, unbalanced.largest),
                                       scale.relative_energy(stress, stress_norm));
  if (rows.contact.count == 0) return estimate;
  const std::vector<PointLaw> open(laws.size());
  const Correction held = solve_under(rows, open, std::move(load), iterations);
  const Eigen::VectorXd map =
      natural_map(rows.contact, compliance, F_C, u_C + rows.of_contact(held.x));
  const double of_map = 2 * std::sqrt(map.cwiseAbs2().dot(compliance));
  const double of_forces = scale.relative_energy(safety * (norm_under_laws + held.norm + of_map),
                                                 rows.norm_from_below(F_C));
  return larger_error(larger_error(estimate, of_forces),
                      scale.relative_force(map.norm(), F_C.norm()));
}

}  // namespace airybench
