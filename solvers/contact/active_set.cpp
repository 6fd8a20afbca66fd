#include "solvers/contact/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/base/dense_products.hpp"
#include "solvers/contact/admm.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/contact/linear_tractions.hpp"
#include "solvers/contact/paired_points.hpp"
#include "solvers/contact/proximal_points.hpp"
#include "solvers/contact/sparse_freedoms.hpp"
#include "solvers/direct/dense_factors.hpp"

namespace airybench {
namespace {

// Several forces may give the same displacements: then the matrix is singular. The shift chooses
// among them and changes no solution.
constexpr double shift = 1e-10;  // of the mean diagonal entry of D

// times: D F; solve: from freedoms and the right-hand side to their z.
template <typename Times, typename Solve>
Eigen::VectorXd step_from(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                          const Eigen::VectorXd& F, const Eigen::VectorXd& r, Times times_D,
                          Solve solve) {
  const int m = contact.components;
  Eigen::VectorXd next = F;
  const std::vector<Freedom> freedoms =
      freedoms_of(contact, D_diagonal, trial_forces(contact, D_diagonal, F, r), next);
  const auto count = static_cast<Eigen::Index>(freedoms.size());
  if (count == 0) return next;
  const Eigen::VectorXd violation = r + times_D(Eigen::VectorXd(next - F));
  Eigen::VectorXd rest(count);
  for (Eigen::Index k = 0; k < count; ++k)
    rest(k) = relation(freedoms[k], m, violation) + freedoms[k].rest;
  const Eigen::VectorXd z = solve(freedoms, rest);
  for (Eigen::Index k = 0; k < count; ++k)
    next.segment(freedoms[k].first, m) -= z(k) * freedoms[k].force.head(m);
  return next;
}

}  // namespace

Eigen::VectorXd active_set_step(const Eigen::MatrixXd& D, const ContactPoints& contact,
                                const Eigen::VectorXd& F, const Eigen::VectorXd& r) {
  if (!contact.opposite.empty()) {
    const contact::Problem one = joined({.D = D, .G = r, .points = contact});
    return at_both(contact,
                   active_set_step(one.D, one.points, of_first(contact, F), of_first(contact, r)));
  }
  const int m = contact.components;
  const Eigen::VectorXd diagonal = D.diagonal();
  const auto solve = [&](const std::vector<Freedom>& freedoms, const Eigen::VectorXd& rest) {
    const Eigen::Index count = rest.size();
    Eigen::MatrixXd matrix(count, count);
    Eigen::VectorXd column(F.size());
    for (Eigen::Index k = 0; k < count; ++k) {
      column.noalias() = D.middleCols(freedoms[k].first, m) * freedoms[k].force.head(m);
      for (Eigen::Index i = 0; i < count; ++i) matrix(i, k) = relation(freedoms[i], m, column);
      matrix(k, k) += freedoms[k].diagonal;
    }
    if (m == 3) matrix.diagonal().array() += shift * diagonal.mean();  // in the plane LU suffices
    return solve_by_lu(std::move(matrix), rest);
  };
  return step_from(
      contact, diagonal, F, r, [&](const Eigen::VectorXd& x) { return times(D, x); }, solve);
}

Eigen::VectorXd active_set_step(const contact::Problem& problem, const Eigen::VectorXd& F,
                                const Eigen::VectorXd& r) {
  if (problem.is_dense()) return active_set_step(problem.D, problem.points, F, r);
  const Eigen::VectorXd diagonal = D_diagonal(problem);
  const double added = shift * diagonal.mean();
  return step_from(
      problem.points, diagonal, F, r, [&](const Eigen::VectorXd& x) { return D_times(problem, x); },
      [&](std::vector<Freedom> freedoms, const Eigen::VectorXd& rest) {
        for (Freedom& freedom : freedoms) freedom.diagonal += added;
        return solve_sparse_freedoms(problem, freedoms, rest);
      });
}

namespace {

// In space the slip's direction turns with the step, which may be too long: halved until the
// natural map falls, or what is least of a few. So it is for the many contacts of a sparse D. In
// the plane only signs change; steps are whole.
Eigen::VectorXd damped(const contact::Problem& problem, const Eigen::VectorXd& F,
                       const Eigen::VectorXd& next, double natural_map_of_F) {
  constexpr int max_halvings = 6;
  if (problem.points.components != 3 && problem.is_dense()) return next;
  Eigen::VectorXd best = next;
  double least = std::numeric_limits<double>::infinity(), part = 1;
  for (int halving = 0; halving <= max_halvings && least >= natural_map_of_F;
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
                          const Deadline& deadline, ContactResult& result,
                          const ActiveSetLimits& limits) {
  const double enough = options.tolerance / 100;
  Eigen::VectorXd F = result.F_C;
  int since_best = 0;
  for (int step = 0; step <= limits.max_steps && since_best <= limits.patience;
       ++step, ++since_best) {
    if (!std::isfinite(F.norm())) break;
    const Eigen::VectorXd u = D_times(problem, F) - problem.G;
    const double relative = relative_natural_map(problem, F, u);
    const double before = result.natural_map_residual;
    if (step == 0 || relative < before) {
      result.F_C = F;
      result.natural_map_residual = relative;
      since_best = 0;
    }
    // Below the tolerance for as long as it still falls: errors are a multiple of the map.
    const double best = result.natural_map_residual;
    if (best <= enough || (best <= options.tolerance && step > 0 && best > before / 2)) break;
    F = damped(problem, F, active_set_step(problem, F, relative_to_gap(problem.points, u)),
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
  if (part.start.size() == 0 && has_linear_tractions(problem)) {
    const ContactResult linear =
        solve_contact_by_newton(in_linear_tractions(problem), options, deadline);
    if (linear.converged) part.start = of_linear_tractions(problem.points, linear.F_C);
    steps = linear.active_set_steps;
  }
  for (int next = first_sweeps;; next = 10 * std::min(next, options.max_iterations)) {
    deadline.check("the active sets of the contact law");
    part.max_iterations = std::min(next, options.max_iterations - sweeps);
    const ContactResult swept = problem.bodies
                                    ? solve_contact_by_admm(problem, part, deadline)
                                    : solve_contact_by_gauss_seidel(problem, part, deadline);
    part.start = swept.F_C;
    sweeps += swept.iterations;
    history.insert(history.end(), swept.history.begin(), swept.history.end());
    ContactResult result = swept;
    finish_by_active_set(problem, options, deadline, result);
    // With a dense D more sweeps, where any are left, are cheaper and mostly do.
    const bool sweeps_again =
        problem.is_dense() && next == first_sweeps && sweeps < options.max_iterations;
    if (!result.converged && !problem.bodies && !sweeps_again && std::isfinite(result.F_C.norm()))
      finish_by_proximal_points(problem, options, deadline, result);
    steps += result.active_set_steps;
    if (best.F_C.size() == 0 || result.natural_map_residual < best.natural_map_residual)
      best = std::move(result);
    const bool diverged = !std::isfinite(swept.F_C.norm());
    if (best.converged || sweeps >= options.max_iterations || diverged) break;
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
  const Eigen::VectorXd off = natural_map(contact, D.diagonal(), F, displacement);
  Eigen::VectorXd change = active_set_step(D, contact, F, r) - F;
  if (!change.allFinite() && off.allFinite()) change = off;  // the statuses' system is singular
  ContactCheck check;
  check.energy_norm = D_norm(D, change);
  check.relative = larger_error(scale.relative_energy(check.energy_norm, D_norm(D, F)),
                                scale.relative_force(off.norm(), F.norm()));
  return check;
}

}  // namespace airybench
