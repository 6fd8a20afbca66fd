// Remarks on an answer, parts of Verdict::reason.
#pragma once

#include <string>
#include <vector>

#include "bench/records/step_result.hpp"
#include "solvers/base/method.hpp"
#include "verify/total_error.hpp"
#include "verify/verifier.hpp"

namespace airybench {

// What contact faces press on, for messages.
inline const char* obstacle_of(const Problem& problem) {
  return problem.opposite.empty() ? "wall" : "wall or other body";
}

// "; the least gap to the wall is 0.012 mm", of the body as it is held, before it deforms; empty:
// it has no contact boundary, or a path of load steps.
std::string words_of_least_gap(const Problem& problem);
// Of the last step: nothing touches, can touch, or is free; bodies that may move without resistance
// and load.
std::vector<std::string> remarks_on_what_is_idle(const Problem& first, const Verification& v);
// Half-size load steps change, in any step, how many points stick or slip, or the resultant by over
// 1 %. whole: of the steps that were not halved.
std::vector<std::string> remarks_on_half_steps(const std::vector<StepResult>& steps,
                                               const std::vector<StepResult>& halves,
                                               int whole = 0);
// Curves that it solves as polygons (Record::polygons), and what of the total error is theirs:
std::string remark_on_polygons(const Method& method, const std::string& polygons,
                               const TotalError& total);
// Strains above 10 %; else empty:
std::string remark_on_large_strains(const Problem& problem, const StressField& stress);

}  // namespace airybench
