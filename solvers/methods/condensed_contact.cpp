// CONDENSED: the contact law alone, of a problem that came condensed.
#include "solvers/contact/condensed.hpp"

#include "solvers/base/method.hpp"

namespace airybench {

static Solution solve_given_contact(const DualSystem& system, const RunControl& control) {
  const GivenContact& given = *system.problem->given;
  Solution solution;
  solve_condensed_contact({given.D, given.b}, system.contact, control, solution);
  return solution;
}

Method condensed_contact() {
  return {.name = "CONDENSED",
          .family = "CONDENSED",
          .summary = "the contact law of a problem that came condensed",
          .takes = Method::Takes::given_contact,
          .blocks = Blocks::contact_points,
          .stages = {Stage::contact},
          .solve = solve_given_contact,
          .knob = AccuracyKnob::contact_sweeps};
}

}  // namespace airybench
