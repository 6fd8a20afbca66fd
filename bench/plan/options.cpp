#include "bench/plan/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "support/numbers.hpp"

namespace airybench {

std::optional<AdaptGoal> adapt_goal_of(const std::string& text) {
  constexpr std::int64_t fewest_unknowns = 100, max_unknowns = 5'000'000;  // --adapt=1: 1%?
  if (const std::optional<double> error = parse_percent(text)) return AdaptGoal{error, {}};
  const std::optional<std::int64_t> unknowns = parse_whole(text);
  if (!unknowns || *unknowns < fewest_unknowns || *unknowns > max_unknowns) return {};
  return AdaptGoal{{}, static_cast<int>(*unknowns)};
}

std::string text_of(const std::vector<AdaptGoal>& goals) {
  std::string text;
  for (const AdaptGoal& goal : goals)
    text += (text.empty() ? "" : ",") +
            (goal.error ? fmt::format("{:g}%", 100 * *goal.error) : std::to_string(*goal.unknowns));
  return text;
}

double phase_limit_s(const Limits& limits) {
  constexpr double min_s = 900;
  return limits.others_s.value_or(std::max(limits.timeout_s, min_s));
}

TimeLimit phase_limit(const std::string& what, const Limits& limits) {
  const double limit_s = phase_limit_s(limits);
  return {limit_s,
          fmt::format("bench: {} took more than {:g} s (more with --timeout=...,others=SECONDS)",
                      what, limit_s)};
}

std::string name_of(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

std::optional<Shard> shard_of(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::optional<std::int64_t> index = parse_whole(text.substr(0, slash));
  const std::optional<std::int64_t> count =
      parse_whole(text.substr(std::min(slash + 1, text.size())));
  if (!index || !count || *index < 1 || *index > *count || *count > std::numeric_limits<int>::max())
    return {};
  return Shard{static_cast<int>(*index), static_cast<int>(*count)};
}

}  // namespace airybench
