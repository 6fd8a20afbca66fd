// A body that is condensed once and solved for several load cases.
//
// S, C, K, their factors and D do not depend on the loads. So another displacement, traction, body
// force, gap or friction costs G, the contact law, the recovery and the check: two solves instead
// of a factorisation and n_c + 1 solves. A body with friction and one without are two bodies: D of
// the latter has the normal rows only.
//
//   RunControl control;
//   control.keep_body = true;
//   const Solution first = run(method, system, control);
//   system.set_load_case(other);                         // contact_system.hpp
//   const Solution second = run(first.solve_again, system, control);
//
// The answer that has solve_again owns the kept body, together with its copies. Not for two threads
// at once.
#pragma once

#include <memory>
#include <utility>

#include "solvers/base/method.hpp"

namespace airybench {

// `solve`, which throws std::invalid_argument for another body than that of the first load case.
Solve for_the_same_body(const ContactSystem& first, Solve solve);

// Sets solve_again if the control asks for it. take_loads(problem): of another load case, into the
// body; finish(load case, control, body, solution): all that follows.
template <typename Body, typename TakeLoads, typename Finish>
void keep_if_told(const ContactSystem& first, const RunControl& control, std::shared_ptr<Body> body,
                  TakeLoads take_loads, Finish finish, Solution& solution) {
  if (!control.keep_body) return;
  solution.solve_again =
      for_the_same_body(first, [body = std::move(body), take_loads, finish](
                                   const ContactSystem& load_case, const RunControl& again) {
        Solution other;
        run_stage(other.times, Stage::contact, MemoryOwner::system_matrix,
                  [&] { take_loads(*load_case.problem, *body); });
        finish(load_case, again, *body, other);
        return other;
      });
}

}  // namespace airybench
