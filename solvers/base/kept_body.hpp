// A body that is condensed once and solved for several load cases.
//
// Neither a factor nor D knows of loads: S, C and K are the body's. So what another displacement,
// traction, body force, gap or friction costs is G, the contact law, the recovery and the check:
// two solves instead of a factorisation and n_c + 1 of them. Without friction other rows are known
// than with it (D has the normal ones only), and that is another body.
//
//   RunControl control;
//   control.keep_body = true;
//   const Solution first = run(method, system, control);
//   set_load_case(system, other);                        // dual_system.hpp
//   const Solution second = run(first.solve_again, system, control);
//
// A kept body is the answer's that has solve_again, and of that answer's copies: not for two
// threads at once.
#pragma once

#include "solvers/base/method.hpp"

namespace airybench {

// `solve`, but std::invalid_argument for what is not the body of the first load case.
Solve for_the_same_body(const DualSystem& first, Solve solve);

}  // namespace airybench
