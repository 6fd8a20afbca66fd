// A body in displacements, condensed once for all load cases (kept_body.hpp).
#pragma once

#include <memory>
#include <utility>

#include "solvers/base/kept_body.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench {

// System: K u = b + F_C; set_load_case(problem, system) replaces b and keeps K.
template <typename System>
struct StiffnessBody {
  System system;
  std::unique_ptr<StiffnessFactor> factor;
  contact::Problem condensed;
};

// Sets solve_again if the control asks for it. finish(load case, control, body, solution): all that
// follows D and G.
template <typename System, typename Finish>
void keep_if_told(const ContactSystem& first, const RunControl& control,
                  std::shared_ptr<StiffnessBody<System>> body, Finish finish, Solution& solution) {
  if (!control.keep_body) return;
  solution.solve_again = for_the_same_body(
      first,
      [body = std::move(body), finish](const ContactSystem& load_case, const RunControl& again) {
        Solution other;
        run_stage(other.times, Stage::contact, MemoryOwner::system_matrix, [&] {
          set_load_case(*load_case.problem, body->system);
          body->condensed.G = body->factor->load(body->system.b);
        });
        finish(load_case, again, *body, other);
        return other;
      });
}

}  // namespace airybench
