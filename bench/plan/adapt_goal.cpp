#include "bench/plan/adapt_goal.hpp"

#include <fmt/format.h>

#include "support/numbers.hpp"

namespace airybench {

std::optional<AdaptGoal> adapt_goal_of(const std::string& text) {
  constexpr std::int64_t most_unknowns = 5'000'000;
  if (const std::optional<double> error = parse_percent(text)) return AdaptGoal{error, {}};
  const std::optional<std::int64_t> unknowns = parse_whole(text);
  if (!unknowns || *unknowns < 1 || *unknowns > most_unknowns) return {};
  return AdaptGoal{{}, static_cast<int>(*unknowns)};
}

std::string text_of(const std::vector<AdaptGoal>& goals) {
  std::string text;
  for (const AdaptGoal& goal : goals)
    text += (text.empty() ? "" : ",") +
            (goal.error ? fmt::format("{:g}%", 100 * *goal.error) : std::to_string(*goal.unknowns));
  return text;
}

}  // namespace airybench
