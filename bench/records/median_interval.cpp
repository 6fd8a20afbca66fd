#include "bench/records/median_interval.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>

#include "bench/records/robust.hpp"

namespace airybench {

std::optional<Interval> median_interval(std::vector<double> samples) {
  constexpr double tail = 0.025;
  if (samples.size() < fewest_for_median_interval) return {};
  // Boost's quantile of a lower tail is rounded down: the largest k with P(B <= k) <= tail.
  const boost::math::binomial below(static_cast<double>(samples.size()), 0.5);
  const auto k = static_cast<std::size_t>(boost::math::quantile(below, tail));
  std::sort(samples.begin(), samples.end());
  return Interval{samples[k], samples[samples.size() - 1 - k]};
}

std::optional<double> median_uncertainty(const std::vector<double>& samples) {
  const std::optional<Interval> interval = median_interval(samples);
  if (!interval) return {};
  const double centre = median(samples);
  return std::max(interval->high - centre, centre - interval->low) / centre;
}

}  // namespace airybench
