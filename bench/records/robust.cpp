#include "bench/records/robust.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace airybench {
namespace {

constexpr double tail = 0.025;  // on each side of an interval

double resampled_median(const std::vector<double>& samples, std::mt19937& engine) {
  std::vector<double> drawn;
  drawn.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    drawn.push_back(samples[engine() % samples.size()]);
  return median(std::move(drawn));
}

template <typename Statistic>
Interval percentile_interval(const Statistic& statistic) {
  constexpr int resamples = 2000;
  std::mt19937 engine(1);
  std::vector<double> figures;
  figures.reserve(resamples);
  for (int i = 0; i < resamples; ++i) figures.push_back(statistic(engine));
  std::sort(figures.begin(), figures.end());
  constexpr auto in_tail = static_cast<std::size_t>(resamples * tail);
  return {figures[in_tail], figures[resamples - 1 - in_tail]};
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + middle, values.end());
  const double upper = values[middle];
  if (values.size() % 2 == 1) return upper;
  return (*std::max_element(values.begin(), values.begin() + middle) + upper) / 2;
}

double median_absolute_deviation(const std::vector<double>& values) {
  const double centre = median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const double value : values) deviations.push_back(std::abs(value - centre));
  return median(std::move(deviations));
}

double robust_standard_deviation(const std::vector<double>& values) {
  static const double quartile = boost::math::quantile(boost::math::normal(), 0.75);
  return median_absolute_deviation(values) / quartile;
}

std::optional<Interval> median_interval(std::vector<double> samples) {
  if (samples.size() < fewest_for_median_interval) return {};
  // Boost rounds this quantile down: the largest k with P(B <= k) <= tail.
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

Interval bootstrap_median(const std::vector<double>& samples) {
  return percentile_interval(
      [&](std::mt19937& engine) { return resampled_median(samples, engine); });
}

Interval bootstrap_ratio_of_medians(const std::vector<double>& numerator,
                                    const std::vector<double>& denominator) {
  return percentile_interval([&](std::mt19937& engine) {
    const double above = resampled_median(numerator, engine);
    return above / resampled_median(denominator, engine);
  });
}

}  // namespace airybench
