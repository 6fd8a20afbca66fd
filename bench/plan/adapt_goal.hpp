// Until when a mesh is adapted: --adapt=1% or --adapt=50000, or one after the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace airybench {

struct AdaptGoal {              // one of the two
  std::optional<double> error;  // total error, relative
  std::optional<int> unknowns;  // n_φ, at least
};

// "1%" is an error, above 0 and below 100 %; "50000" a number of unknowns, 1 to 5 000 000. Empty:
// it is neither.
std::optional<AdaptGoal> adapt_goal_of(const std::string& text);

std::string text_of(const std::vector<AdaptGoal>& goals);  // the same text again: "1%,50000"

}  // namespace airybench
