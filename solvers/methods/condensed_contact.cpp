// CONDENSED: the contact law alone, of a problem that comes condensed.
#include "solvers/contact/condensed.hpp"

#include "solvers/base/method.hpp"

namespace airybench {

Method condensed_contact() {
  return {.name = "CONDENSED",
          .family = "CONDENSED",
          .summary = "the contact law of a problem that came condensed",
          .unknowns = Unknowns::contact_forces,
          .stages = {Stage::contact},
          .solve_contact =
              [](const contact::Problem& problem, const RunControl& control) {
                Solution solution;
                solve_condensed_contact(problem, control, solution);
                return solution;
              },
          .knob = AccuracyKnob::contact_sweeps};
}

}  // namespace airybench
