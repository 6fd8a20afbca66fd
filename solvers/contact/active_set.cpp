#include "solvers/contact/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/base/dense_products.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/contact/point_laws.hpp"
#include "solvers/direct/dense_factors.hpp"

namespace airybench {

namespace {

// An unknown z of the linear system, at one point: F changes by z · force; in return
// r_component + diagonal · z = −rest there, or, across a slip, force · r in place of a component.
struct Freedom {
  int first;  // row of the point
  int component;
  Eigen::Vector3d force;
  double diagonal = 0, rest = 0;
};
constexpr int across_slip = -1;

Freedom along(int first, int component) {
  return {first, component, Eigen::Vector3d::Unit(component)};
}

// Of a point that slips in space, where z = (F − ρ r)_t, e = z/|z|, q = −|z| / (μ F_n) ≥ 1: along e
// F_t = −μ F_n e, and across it, f ⊥ e, Newton's method for F_t = (−μ F_n / |z|) z says
//
//   f · r_t + (q − 1) f · F_t / ρ = 0,  which is f · r_t = 0 at the onset of slip.
void add_slip_in_space(int n, double mu, double rho, const Eigen::Vector3d& trial,
                       Eigen::VectorXd& F, std::vector<Freedom>& freedoms) {
  const Eigen::Vector2d e = trial.tail<2>().normalized(), f(-e.y(), e.x());
  const double across = f.dot(F.segment<2>(n + 1));
  Freedom normal = along(n, 0);
  normal.force.tail<2>() = -mu * e;
  freedoms.push_back(normal);
  F.segment<2>(n + 1) = -mu * F(n) * e + across * f;
  if (mu == 0) return;
  const double q = std::max(1.0, -trial.tail<2>().norm() / (mu * std::min(trial(0), 0.0)));
  const double diagonal = (q - 1) / rho;
  freedoms.push_back({n, across_slip, {0, f.x(), f.y()}, diagonal, diagonal * across});
}

// What is free under the laws of the trial F − ρ r; F takes the forces that they prescribe.
std::vector<Freedom> freedoms_of(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                                 const Eigen::VectorXd& trial, Eigen::VectorXd& F) {
  const int m = contact.components;
  std::vector<Freedom> freedoms;
  freedoms.reserve(static_cast<std::size_t>(F.size()));
  const std::vector<PointLaw> laws = laws_of(contact, trial);
  for (int p = 0; p < contact.count; ++p) {
    const int n = m * p;
    if (!laws[p].closed) {
      F.segment(n, m).setZero();
    } else if (m == 1 || laws[p].sticks) {
      for (int k = 0; k < m; ++k) freedoms.push_back(along(n, k));
    } else if (m == 2) {
      Freedom slip = along(n, 0);
      slip.force(1) = laws[p].ratio;
      F(n + 1) = slip.force(1) * F(n);
      freedoms.push_back(slip);
    } else {
      const double rho = 1 / D_diagonal.segment<2>(n + 1).mean();
      add_slip_in_space(n, contact.friction_at(p), rho, trial.segment<3>(n), F, freedoms);
    }
  }
  return freedoms;
}

}  // namespace

Eigen::VectorXd active_set_step(const Eigen::MatrixXd& D, const ContactPoints& contact,
                                const Eigen::VectorXd& F, const Eigen::VectorXd& r) {
  const int m = contact.components;
  const Eigen::VectorXd diagonal = D.diagonal();
  Eigen::VectorXd next = F;
  const std::vector<Freedom> freedoms =
      freedoms_of(contact, diagonal, trial_forces(contact, diagonal, F, r), next);
  const auto count = static_cast<Eigen::Index>(freedoms.size());
  if (count == 0) return next;
  const auto relation = [&](const Freedom& of, const Eigen::VectorXd& at) {
    return of.component == across_slip ? of.force.head(m).dot(at.segment(of.first, m))
                                       : at(of.first + of.component);
  };
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd column(F.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    column.noalias() = D.middleCols(freedoms[k].first, m) * freedoms[k].force.head(m);
    for (Eigen::Index i = 0; i < count; ++i) matrix(i, k) = relation(freedoms[i], column);
    matrix(k, k) += freedoms[k].diagonal;
  }
  // In space D is often singular: several forces give the same displacements. The shift chooses
  // among them and changes no solution.
  constexpr double shift = 1e-10;
  if (m == 3) matrix.diagonal().array() += shift * diagonal.mean();
  const Eigen::VectorXd violation = r + times(D, next - F);
  Eigen::VectorXd rest(count);
  for (Eigen::Index k = 0; k < count; ++k)
    rest(k) = relation(freedoms[k], violation) + freedoms[k].rest;
  const Eigen::VectorXd change = solve_by_lu(std::move(matrix), rest);
  for (Eigen::Index k = 0; k < count; ++k)
    next.segment(freedoms[k].first, m) -= change(k) * freedoms[k].force.head(m);
  return next;
}

namespace {

// In space the slip's direction turns with the step, which may be too long: halved until the
// natural map falls, or what is least of a few. In the plane only signs change; steps are whole.
Eigen::VectorXd damped(const contact::Problem& problem, const Eigen::VectorXd& F,
                       const Eigen::VectorXd& next, double natural_map_of_F) {
  constexpr int most_halvings = 6;
  if (problem.points.components != 3) return next;
  Eigen::VectorXd best = next;
  double least = std::numeric_limits<double>::infinity(), part = 1;
  for (int halving = 0; halving <= most_halvings && least >= natural_map_of_F;
       ++halving, part /= 2) {
    const Eigen::VectorXd tried = F + part * (next - F);
    const double natural_map = relative_natural_map(problem, tried);
    if (natural_map < least) {
      least = natural_map;
      best = tried;
    }
  }
  return best;
}

}  // namespace

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
    F = damped(problem, F,
               active_set_step(problem.D, problem.points, F, relative_to_gap(problem.points, u)),
               relative);
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
