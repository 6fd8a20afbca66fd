#include "solvers/contact/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/base/dense_products.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/contact/point_laws.hpp"
#include "solvers/direct/dense_factors.hpp"

namespace airybench {

Eigen::VectorXd active_set_step(const Eigen::MatrixXd& D, const ContactPoints& contact,
                                const Eigen::VectorXd& F, const Eigen::VectorXd& r) {
  const int m = contact.components;
  // F = Σ_k z_k (e_row + ratio_k e_{row+1}) over the closed components: a sticking point has two, a
  // slipping one the normal one, which takes F_t = ratio F_n along. Row by row r = 0 is asked for.
  std::vector<int> row;
  std::vector<double> ratio;
  row.reserve(static_cast<std::size_t>(F.size()));
  ratio.reserve(static_cast<std::size_t>(F.size()));
  const std::vector<PointLaw> laws = laws_of(contact, F - r.cwiseQuotient(D.diagonal()));
  Eigen::VectorXd next = Eigen::VectorXd::Zero(F.size());  // F with the statuses' forces in it
  for (int p = 0; p < contact.count; ++p) {
    const int n = m * p, t = n + 1;
    if (!laws[p].closed) continue;
    row.push_back(n);
    ratio.push_back(laws[p].ratio);
    next(n) = F(n);
    if (m == 1) continue;
    if (laws[p].sticks) {
      row.push_back(t);
      ratio.push_back(0);
      next(t) = F(t);
    } else {
      next(t) = laws[p].ratio * F(n);
    }
  }
  const auto closed = static_cast<Eigen::Index>(row.size());
  if (closed == 0) return next;
  Eigen::MatrixXd matrix(closed, closed);
  for (Eigen::Index k = 0; k < closed; ++k) {
    const auto column = D.col(row[k]);
    if (ratio[k] == 0) {
      for (Eigen::Index i = 0; i < closed; ++i) matrix(i, k) = column(row[i]);
    } else {
      const auto along = D.col(row[k] + 1);
      for (Eigen::Index i = 0; i < closed; ++i)
        matrix(i, k) = column(row[i]) + ratio[k] * along(row[i]);
    }
  }
  const Eigen::VectorXd violation = r + times(D, next - F);
  const Eigen::VectorXd change = solve_by_lu(std::move(matrix), violation(row));
  for (Eigen::Index k = 0; k < closed; ++k) {
    next(row[k]) -= change(k);
    if (ratio[k] != 0) next(row[k] + 1) -= ratio[k] * change(k);
  }
  return next;
}

void finish_by_active_set(const contact::Problem& problem, const ContactOptions& options,
                          const Deadline& deadline, ContactResult& result) {
  constexpr int most_steps = 100, patience = 15;  // steps without a smaller natural map
  const double enough = options.tolerance / 100;
  Eigen::VectorXd F = result.F_C;
  int since_best = 0;
  for (int step = 0; step <= most_steps && since_best <= patience; ++step, ++since_best) {
    if (!std::isfinite(F.norm())) break;
    const Eigen::VectorXd u = times(problem.D, F) - problem.G;
    const double relative = relative_natural_map(problem.points, problem.D.diagonal(), F, u);
    const double before = result.natural_map_residual;
    if (step == 0 || relative < before) {
      result.F_C = F;
      result.natural_map_residual = relative;
      since_best = 0;
    }
    // Below the tolerance for as long as it still falls: errors are a multiple of the map.
    const double best = result.natural_map_residual;
    if (best <= enough || (best <= options.tolerance && step > 0 && best > before / 2)) break;
    F = active_set_step(problem.D, problem.points, F, relative_to_gap(problem.points, u));
    ++result.active_set_steps;
    deadline.check("the active sets of the contact law");
  }
  result.converged = result.natural_map_residual <= std::max(options.tolerance, options.acceptable);
}

ContactResult solve_contact_by_newton(const contact::Problem& problem,
                                      const ContactOptions& options, const Deadline& deadline) {
  constexpr int first_sweeps = 10;  // from fewer, active sets may cycle
  ContactResult best;
  ContactOptions part = options;
  int sweeps = 0, steps = 0;
  std::vector<double> history;
  for (int next = first_sweeps;; next *= 10) {
    part.most_iterations = std::min(next, options.most_iterations - sweeps);
    const ContactResult swept = solve_contact_by_gauss_seidel(problem, part, deadline);
    part.start = swept.F_C;
    sweeps += swept.iterations;
    history.insert(history.end(), swept.history.begin(), swept.history.end());
    ContactResult result = swept;
    finish_by_active_set(problem, options, deadline, result);
    steps += result.active_set_steps;
    if (best.F_C.size() == 0 || result.natural_map_residual < best.natural_map_residual)
      best = std::move(result);
    if (best.converged || sweeps >= options.most_iterations || !swept.F_C.allFinite()) break;
  }
  best.iterations = sweeps;
  best.active_set_steps = steps;
  best.history = std::move(history);
  return best;
}

ContactCheck check_contact(const Eigen::MatrixXd& D, const ContactPoints& contact,
                           const Eigen::VectorXd& F, const Eigen::VectorXd& displacement,
                           const LoadScale& scale) {
  const Eigen::VectorXd r = relative_to_gap(contact, displacement);
  ContactCheck check;
  check.energy_norm = D_norm(D, active_set_step(D, contact, F, r) - F);
  const double off = natural_map(contact, D.diagonal(), F, displacement).norm();
  check.relative = larger_error(relative_error(check.energy_norm, D_norm(D, F), scale.energy_norm),
                                relative_error(off, F.norm(), scale.force_N));
  return check;
}

}  // namespace airybench
