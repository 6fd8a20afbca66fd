#include "bench/report/change_point.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "bench/records/robust.hpp"

namespace airybench {
namespace {

constexpr double outlier_share = 0.1;    // ε
constexpr double outlier_scale = 0.25;   // ω
constexpr double least_scale = 0.005;    // clocks and caches scatter at least so much
constexpr double common_weight = 10;     // nights that the common scale counts for
constexpr double agreeing_share = 0.75;  // of the nights after a change
constexpr double standard_errors = 1.1;  // by which the effect must be above the least one
constexpr int iterations = 6;  // of expectation maximisation: levels stand to a tenth of σ/√n

// φ(e; s) without the factor (2 π)^-1/2, which cancels everywhere.
double bell(double e, double s) { return std::exp(-e * e / (2 * s * s)) / s; }
double usual(double e, double scale) { return (1 - outlier_share) * bell(e, scale); }
double density(double e, double scale) {
  return usual(e, scale) + outlier_share * bell(e, outlier_scale);
}

struct Level {
  double value = 0, scale = 0;
  double nights = 0;  // that are no outliers
};

// Maximum likelihood under g from the median on, by expectation maximisation: each value counts
// with the probability that it is no outlier.
Level level_of(const std::vector<double>& values, double scale, bool scale_is_known) {
  Level level{median(values), scale, 0};
  for (int i = 0; i < iterations; ++i) {
    double nights = 0, sum = 0, squares = 0;
    for (const double x : values) {
      const double e = x - level.value;
      const double weight = usual(e, level.scale) / density(e, level.scale);
      nights += weight;
      sum += weight * e;
      squares += weight * e * e;
    }
    level.nights = nights;
    if (nights < 1.5) break;  // all are outliers to each other
    level.value += sum / nights;
    if (!scale_is_known) level.scale = std::max(least_scale, std::sqrt(squares / (nights - 1)));
  }
  return level;
}

// Between the series' own scale and the common one, by the nights that each rests on.
Level level_before(const std::vector<double>& before, double common_scale) {
  // The robust start keeps outliers from being taken for the scale.
  const double start = std::max({least_scale, common_scale / 2, robust_standard_deviation(before)});
  const double own = level_of(before, start, false).scale;
  const auto weight = static_cast<double>(before.size());
  const double variance =
      (weight * own * own + common_weight * common_scale * common_scale) / (weight + common_weight);
  return level_of(before, std::sqrt(variance), true);
}

double log_likelihood(const std::vector<double>& values, double level, double scale) {
  double sum = 0;
  for (const double x : values) sum += std::log(density(x - level, scale));
  return sum;
}

// λ of the normal quantile: z² / 2.
double least_lambda(double false_alarm_level) {
  const double z = boost::math::quantile(complement(boost::math::normal(), false_alarm_level));
  return z * z / 2;
}

struct Series {
  std::vector<double> values;
  std::vector<std::size_t> nights;  // of the values
};

Series measured(const std::vector<double>& series) {
  Series result;
  for (std::size_t t = 0; t < series.size(); ++t)
    if (std::isfinite(series[t])) {
      result.values.push_back(series[t]);
      result.nights.push_back(t);
    }
  return result;
}

}  // namespace

double scale_of(const std::vector<double>& series) {
  const std::vector<double> values = measured(series).values;
  return values.size() < 2 ? std::nan("")
                           : std::max(least_scale, robust_standard_deviation(values));
}

std::optional<Change> find_change(const std::vector<double>& series, double common_scale,
                                  const ChangePointRules& rules) {
  const auto [values, nights] = measured(series);
  const double least_shift = std::log1p(rules.minimum_effect);
  const double least_rise = least_lambda(rules.rise_level);
  const double least_fall = least_lambda(rules.fall_level);
  const double normal_95 = boost::math::quantile(boost::math::normal(), 0.975);
  std::optional<Change> change;
  double largest = 0;  // of λ above what is needed
  for (std::size_t n = rules.least_after; n <= rules.most_after; ++n) {
    if (n + rules.least_before > values.size()) break;
    const std::vector<double> before(values.begin(), values.end() - n);
    const std::vector<double> after(values.end() - n, values.end());
    // Most nights end here; a median is not far from the level.
    if (std::abs(median(after) - median(before)) < 0.8 * least_shift) continue;
    const Level old_level = level_before(before, common_scale);
    const Level new_level = level_of(after, old_level.scale, true);
    const double shift = new_level.value - old_level.value;
    const double error = old_level.scale * std::sqrt(1 / old_level.nights + 1 / new_level.nights);
    if (std::abs(shift) - standard_errors * error < least_shift ||
        new_level.nights < static_cast<double>(rules.least_after) - 0.5 ||
        new_level.nights < agreeing_share * static_cast<double>(n))
      continue;
    const double lambda = old_level.nights / (old_level.nights + new_level.nights) *
                          (log_likelihood(after, new_level.value, old_level.scale) -
                           log_likelihood(after, old_level.value, old_level.scale));
    const double excess = lambda - (shift > 0 ? least_rise : least_fall);
    if (excess <= largest) continue;
    largest = excess;
    change = Change{nights[nights.size() - n], shift, shift - normal_95 * error,
                    shift + normal_95 * error};
  }
  return change;
}

}  // namespace airybench
