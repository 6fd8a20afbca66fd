#include "solvers/contact/condensed.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "solvers/base/dense_products.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/admm.hpp"
#include "solvers/contact/anderson.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/contact/paired_points.hpp"

namespace airybench {

double D_norm(const Eigen::MatrixXd& D, const Eigen::VectorXd& F) {
  const double squared = F.dot(times(D, F));
  return squared < 0 ? 0 : std::sqrt(squared);  // NaN is no zero
}

Eigen::VectorXd contact_offset(const contact::Problem& problem) {
  const Eigen::VectorXd& gap = problem.points.gap;
  return gap.size() > 0 ? Eigen::VectorXd(problem.G + gap) : problem.G;
}

double undoing_force_N(const contact::Problem& problem) {
  const Eigen::VectorXd moved = sums_of_pairs(problem.points, Eigen::VectorXd(-problem.G));
  return project_on_coulomb(problem.points,
                            trial_forces(problem.points, D_diagonal(problem),
                                         Eigen::VectorXd::Zero(moved.size()), moved))
      .norm();
}

double relative_natural_map(const contact::Problem& problem, const Eigen::VectorXd& F,
                            const Eigen::VectorXd& displacement) {
  return relative_natural_map(problem.points, D_diagonal(problem), F, displacement,
                              undoing_force_N(problem));
}
double relative_natural_map(const contact::Problem& problem, const Eigen::VectorXd& F) {
  return relative_natural_map(problem, F, D_times(problem, F) - problem.G);
}

ContactResult solve_contact(const contact::Problem& problem, const ContactOptions& options,
                            const Deadline& deadline) {
  const int size = problem.points.size();
  if (options.start.size() != 0 && options.start.size() != size)
    throw std::invalid_argument("ContactOptions::start: " + std::to_string(options.start.size()) +
                                " contact forces (allowed: none or " + std::to_string(size) + ")");
  if (!problem.points.opposite.empty()) {
    ContactOptions of_joined = options;
    if (options.start.size() > 0) of_joined.start = of_first(problem.points, options.start);
    ContactResult result = solve_contact(joined(problem), of_joined, deadline);
    result.F_C = at_both(problem.points, result.F_C);
    return result;
  }
  if (!problem.points.free.is_empty()) return solve_with_free_bodies(problem, options, deadline);
  if (options.by) return options.by(problem);
  switch (options.solver) {
    case ContactSolver::newton:
      return solve_contact_by_newton(problem, options, deadline);
    case ContactSolver::gauss_seidel:
      return solve_contact_by_gauss_seidel(problem, options, deadline);
    case ContactSolver::anderson:
      return solve_contact_by_anderson(problem, options, deadline);
    case ContactSolver::admm:
      return solve_contact_by_admm(problem, options, deadline);
  }
  throw std::logic_error("no such contact solver");
}

void solve_condensed_contact(const contact::Problem& problem, const RunControl& control,
                             Solution& solution) {
  solution.status = Status::ok;
  solution.message.clear();
  if (problem.points.size() == 0) {
    if (!problem.points.free.is_empty()) refuse_loads_on_open_motions(*problem.points.free.rigid);
    return;
  }
  const StageTimer timer(solution.times, Stage::contact);
  const OwnerScope scope(MemoryOwner::condensed);
  ContactOptions options = control.contact;
  options.history = control.histories;
  if (control.stop == Stop::paper) options.solver = ContactSolver::gauss_seidel;
  ContactResult result = solve_contact(problem, options, control.deadline);
  solution.F_C = std::move(result.F_C);
  solution.free_motion_mm = std::move(result.free_motion_mm);
  solution.contact_iterations = result.iterations;
  solution.newton_steps = result.active_set_steps;
  if (control.histories) {
    IterationHistory& history = solution.histories.emplace_back();
    history.what = "relative change of F_C per iteration of the contact law";
    history.residual = std::move(result.history);
  }
  if (!result.converged) {
    std::ostringstream message;
    message << "natural map residual " << result.natural_map_residual << " after "
            << result.iterations << " iterations and " << result.active_set_steps
            << " active sets (tolerance " << options.tolerance << ")";
    stop_unconverged("contact law", !std::isnan(result.natural_map_residual), message.str(),
                     solution);
  }
}

}  // namespace airybench
