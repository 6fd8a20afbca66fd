// Active sets for the condensed contact problem: Newton's method on the natural map, which is
// piecewise smooth (Alart & Curnier 1991, doi:10.1016/0045-7825(91)90022-X; Hüeber & Wohlmuth 2005,
// doi:10.1016/j.cma.2004.08.006).
//
// F − ρ r says for every point which law it is taken to follow, with ρ_n = 1/D_nn, ρ_t = 1/D_tt:
//
//   (F − ρ r)_n ≥ 0           open    F_n = 0,  F_t = 0
//   |(F − ρ r)_t| ≤ −μ (…)_n  stick   r_n = 0,  r_t = 0
//   else, τ = ±1              slip    r_n = 0,  F_t = −τ μ F_n    τ the sign of (F − ρ r)_t
//
// In space τ is the direction of (F − ρ r)_t, and its turning is part of the linear system.
//
// With these held the law is a linear system for the change of F, whose right-hand side is r: as
// accurate as r is. Where the statuses repeat themselves the step is the last one. There is no
// proof that they do; what comes out counts by its natural map only. A step costs an LU of the
// closed components: dense, or sparse where D is (sparse_freedoms.hpp).
#pragma once

#include "assembly/problem/load_scale.hpp"
#include "solvers/contact/condensed.hpp"

namespace airybench {

// The F after one step from F, where r = ū_C − ḡ belongs to F.
Eigen::VectorXd active_set_step(const Eigen::MatrixXd& D, const ContactPoints& contact,
                                const Eigen::VectorXd& F, const Eigen::VectorXd& r);
// The same with D in any form. Throws std::bad_alloc.
Eigen::VectorXd active_set_step(const contact::Problem& problem, const Eigen::VectorXd& F,
                                const Eigen::VectorXd& r);

// Goes on from a result, and replaces it by a better one, if it finds one: until the natural map is
// a hundredth of options.tolerance, or, below that tolerance, no longer halves.
struct ActiveSetLimits {
  int max_steps = 100, patience = 15;  // patience: steps without a smaller natural map
};
void finish_by_active_set(const contact::Problem& problem, const ContactOptions& options,
                          const Deadline& deadline, ContactResult& result,
                          const ActiveSetLimits& limits = {});

// A few sweeps, then active sets; where these do not end, ten times as many sweeps, and active sets
// again: what sweeps alone solve is solved. Where D is not formed ADMM iterates in place of sweeps;
// where it is, proximal points (proximal_points.hpp) follow on active sets that do not end, with a
// dense D from the second time on, or where no sweeps are left.
ContactResult solve_contact_by_newton(const contact::Problem& problem,
                                      const ContactOptions& options = {},
                                      const Deadline& deadline = {});

// How wrong F is, with displacements ū_C that belong to it and are more accurate than D F − G. One
// more step gives ΔF, the error to first order, where the statuses are right. Where it has none, as
// on a slope as steep as friction, ΔF is the natural map, in N.
struct ContactCheck {
  double energy_norm = 0;  // √(ΔFᵀ D ΔF), √(N mm); it is in the stresses, too
  double relative = 0;     // the larger of ‖ΔF‖_D / ‖F‖_D and ‖natural map‖ / ‖F‖
};
ContactCheck check_contact(const Eigen::MatrixXd& D, const ContactPoints& contact,
                           const Eigen::VectorXd& F, const Eigen::VectorXd& displacement,
                           const LoadScale& scale);

}  // namespace airybench
