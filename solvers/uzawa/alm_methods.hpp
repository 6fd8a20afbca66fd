// ALM: the augmented Lagrangian method with given parameters, and with the best of the paper's
// grid.
#pragma once

#include "solvers/method.hpp"
#include "solvers/uzawa/augmented_lagrangian.hpp"

namespace airybench {

// ALM:r=…,rho=…
Solution solve_augmented_lagrangian(const DualSystem& system, const RunControl& control, double r,
                                    double rho);

// The paper's 8 × 8 grid, [1, 20, 40, 60, 80, 100, 200, 300]² for (r, ρ): the combination that
// meets the stop in the fewest iterations. One factorisation per r; the ρ of one r run side by
// side; a combination is given up at as many iterations as the best so far needed. When time is up,
// what was found until then counts. Throws Breakdown when none converges, TimeoutReached when none
// has until then.
Tuning tune_augmented_lagrangian(const DualSystem& system, const RunControl& control);

}  // namespace airybench
