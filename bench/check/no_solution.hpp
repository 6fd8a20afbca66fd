// A problem without a solution, in the kind that a program reads.
#pragma once

#include "bench/plan/plan.hpp"

namespace airybench {

// What the program makes of it. The body is changed where the program reads one: known forces that
// contradict one another in the Airy system; a body without supports that is pulled off its walls.
// A condensed problem is a rigid body, wedged between two walls that are too near to one another.
Solution answer_without_solution(const Method& program, const PosedScene& scene,
                                 const RunControl& control);

}  // namespace airybench
