// Nonlinear Gauss–Seidel for the condensed contact problem (NSGS; Jean & Moreau; Bisegna, Lebon &
// Maceri 2004): sweep over the points, solve each point's law exactly with all others held.
//
//   for every point p:  b = Σ_{q≠p} D_pq F_q − G_p − ḡ_p,   F_p from the law with r = D_pp F_p + b
#pragma once

#include <limits>

#include "assembly/dual_system.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/contact/condensed.hpp"

namespace airybench {

struct ContactResult {
  Eigen::VectorXd F_C;  // N
  bool converged = false;  // ‖natural map‖ ≤ tolerance · ‖F_C‖, or acceptable at the last sweep
  int sweeps = 0;
  int active_set_steps = 0;  // after the sweeps (active_set.hpp)
  double natural_map_residual = std::numeric_limits<double>::infinity();  // relative to ‖F_C‖
  std::vector<double> history;  // ‖change of a sweep‖/‖F_C‖; kept if the control says so
};

// Starts from `start`; empty: F_C = 0. Not converged after control.contact_sweeps, or when a force
// is not finite. Nothing is allocated inside a sweep, but for the history.
ContactResult solve_contact_by_gauss_seidel(const CondensedSystem& condensed,
                                            const ContactPoints& contact, const RunControl& control,
                                            const Eigen::VectorXd& start = {});

}  // namespace airybench
