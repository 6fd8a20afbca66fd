// The condensed contact problem (contact_problem.hpp): what its solvers return, how they know that
// they are done, and the last stage of a method.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/contact_problem.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {

struct ContactResult {
  Eigen::VectorXd F_C;             // N
  Eigen::VectorXd free_motion_mm;  // a of ContactPoints::free; empty: there is none
  // By ContactOptions::tolerance, or by ContactOptions::acceptable where it ended.
  bool converged = false;
  int iterations = 0;        // sweeps
  int active_set_steps = 0;  // active_set.hpp
  // Of coulomb_law.hpp; infinity: not computed; NaN: a force is not finite.
  double natural_map_residual = std::numeric_limits<double>::infinity();
  std::vector<double> history;  // ‖change of an iteration‖/‖F_C‖; if ContactOptions::history
};

// The size of the forces that would undo −G at every point alone, where that presses.
double undoing_force_N(const contact::Problem& problem);
// That of coulomb_law.hpp; without a displacement ū_C = D F − G.
double relative_natural_map(const contact::Problem& problem, const Eigen::VectorXd& F,
                            const Eigen::VectorXd& displacement);
double relative_natural_map(const contact::Problem& problem, const Eigen::VectorXd& F);

// By options.by or options.solver, pairs and free bodies by theirs (paired_points.hpp,
// free_bodies.hpp). Throws TimeoutReached, Breakdown.
ContactResult solve_contact(const contact::Problem& problem, const ContactOptions& options = {},
                            const Deadline& deadline = {});

// G + ḡ, so that r = D F − offset.
Eigen::VectorXd contact_offset(const contact::Problem& problem);

// Iterates F ← next(F), which returns the norm of its change, until the natural map is below the
// tolerance or options.max_iterations are done, and says which. The map is asked for when the
// change is below the tolerance. Throws TimeoutReached.
template <typename Next>
ContactResult iterate_contact(const contact::Problem& problem, const ContactOptions& options,
                              const Deadline& deadline, Next next) {
  ContactResult result;
  Eigen::VectorXd& F = result.F_C;
  F = options.start.size() > 0 ? options.start : Eigen::VectorXd::Zero(problem.points.size());
  const double undoing_N = undoing_force_N(problem);
  const auto ask = [&](double allowed) {
    result.natural_map_residual = relative_natural_map(problem, F);
    return result.natural_map_residual <= allowed;
  };
  while (result.iterations < options.max_iterations && !result.converged) {
    const double change = next(F);
    ++result.iterations;
    const double norm = F.norm();
    if (!std::isfinite(norm)) {
      result.natural_map_residual = std::numeric_limits<double>::quiet_NaN();
      return result;
    }
    if (options.history) result.history.push_back(norm > 0 ? change / norm : 0);
    if (change <= options.tolerance * size_of_forces(norm, undoing_N))
      result.converged = ask(norm > 0 ? options.tolerance : 0);
    if (result.iterations % 64 == 0) deadline.check("the contact law's iterations");
  }
  if (!result.converged && result.iterations > 0) {
    const bool any = F.squaredNorm() > 0;
    result.converged = ask(any ? std::max(options.tolerance, options.acceptable) : 0);
  }
  return result;
}

// ‖F‖_D = √(Fᵀ D F), √(N mm): the energy norm of the stresses that contact forces alone make.
double D_norm(const Eigen::MatrixXd& D, const Eigen::VectorXd& F);

// Solves the contact law by solve_contact() into the solution: forces, status, counts and history.
// Without contact points there is nothing to do and the status is ok.
void solve_condensed_contact(const contact::Problem& problem, const RunControl& control,
                             Solution& solution);

}  // namespace airybench
