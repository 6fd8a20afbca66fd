// Load steps: a path of loads, with Coulomb's law in increments of slip.
//
// Friction remembers. At every step
//
//   |F_t| ≤ −μ F_n,   F_t Δr_t ≤ 0,   Δr_t ≠ 0 only if |F_t| = −μ F_n,   Δr_t = u_t − s
//
// where s is u_t of the step before, 0 at first. That is the law of a single load case with s in
// the tangential gap (Loads::slid_mm); from step to step s grows by Δr_t, where the body has lifted
// off, too. Signorini's law has no memory. (Implicit Euler for the quasi-static problem.)
//
// The body is condensed or factorised once where the method can (kept_body.hpp), and what a step
// costs is a load case; a condensed law begins with the forces of the step before. A step that
// loads what was held, or holds what was loaded, is another body, with the slip so far. A path is
// not its last step: unloading leaves tangential forces behind. But where everything grows in
// proportion, without gap, one step and many are the same.
#pragma once

#include "solvers/base/method.hpp"

namespace airybench {

// s of the next step, as in Loads: on every edge the polynomial of the stresses' degree that has
// the moments of u_t, of P2 u_t itself. Empty without friction.
Eigen::MatrixXd slid_after(const ContactSystem& system, const Solution& answer);

// The work of friction in a step, −Σ F_t Δr_t ≥ 0, N mm; zero without friction.
double dissipation_Nmm(const ContactSystem& system, const Solution& answer);

// The same path with every step in two halves: in the middle loads and gap are the mean of what
// they are before and after. Before the first the body has no load, and the gap that it has there.
// A step with other supports than the one before has no middle: it comes whole, twice.
Problem with_half_steps(const Problem& first);

// step: from 0. The system is that of the step, its slip measured from this path's own past.
using VisitStep =
    std::function<void(int step, const ContactSystem& system, const Solution& answer)>;

// A problem without its later steps. Where a free motion was found, the system's problem knows it
// then (free_motions.hpp).
Solution solve_load_case(const Solve& solve, ContactSystem& system, const RunControl& control);

// Solves a problem and its later steps, and calls visit() after each. Stops at the first step that
// has no answer. Returns the last answer; the system then has its load case.
Solution solve_load_steps(const Solve& solve, ContactSystem& system, const RunControl& control,
                          const VisitStep& visit = {});
Solution solve_load_steps(const Method& method, const std::shared_ptr<const Problem>& first,
                          const RunControl& control, const VisitStep& visit = {});

}  // namespace airybench
