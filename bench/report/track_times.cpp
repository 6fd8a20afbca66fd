#include "bench/report/track_times.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "bench/records/robust.hpp"

namespace airybench {
namespace {

constexpr double outlier_share = 0.1;    // ε
constexpr double outlier_scale = 0.25;   // ω
constexpr double min_scale = 0.005;      // from clocks and caches
constexpr double common_weight = 10;     // of the common scale, in runs
constexpr double agreeing_share = 0.75;  // of the runs after a change
constexpr double standard_errors = 1.1;  // of margin above the least effect
constexpr double rises_share = 0.9;      // slowdowns matter more than their opposite

// φ(e; s) without (2 π)^-1/2, which cancels.
double bell(double e, double s) { return std::exp(-e * e / (2 * s * s)) / s; }
double usual(double e, double scale) { return (1 - outlier_share) * bell(e, scale); }
double density(double e, double scale) {
  return usual(e, scale) + outlier_share * bell(e, outlier_scale);
}

struct Level {
  double value = 0, scale = 0;
  double runs = 0;  // without outliers
};

// Maximum likelihood under g by expectation maximisation: each value is weighted with the
// probability that it is no outlier.
Level level_of(const std::vector<double>& values, double scale, bool scale_is_known) {
  constexpr int iterations = 6;  // then the level is known to a tenth of σ/√n
  Level level{median(values), scale, 0};
  for (int i = 0; i < iterations; ++i) {
    double runs = 0, sum = 0, squares = 0;
    for (const double x : values) {
      const double e = x - level.value;
      const double weight = usual(e, level.scale) / density(e, level.scale);
      runs += weight;
      sum += weight * e;
      squares += weight * e * e;
    }
    level.runs = runs;
    if (runs < 1.5) break;  // all are outliers to each other
    level.value += sum / runs;
    if (!scale_is_known) level.scale = std::max(min_scale, std::sqrt(squares / (runs - 1)));
  }
  return level;
}

Level level_before(const std::vector<double>& before, double common_scale) {
  // The robust start keeps outliers out of the scale.
  const double start = std::max({min_scale, common_scale / 2, robust_standard_deviation(before)});
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

double min_lambda(double false_alarm_level) {
  const double z = boost::math::quantile(complement(boost::math::normal(), false_alarm_level));
  return z * z / 2;
}

std::vector<double> measured(std::vector<double> series) {
  std::erase_if(series, [](double x) { return !std::isfinite(x); });
  return series;
}

// rows: cases; runs that do not count are NaN.
std::vector<double> common_factor(const std::vector<std::vector<double>>& rows, std::size_t runs) {
  constexpr int sweeps = 3;  // then changes are below 0.1 %
  std::vector<double> factor(runs, 0.0), levels(rows.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t c = 0; c < rows.size(); ++c) {
      std::vector<double> rest = rows[c];
      for (std::size_t t = 0; t < runs; ++t) rest[t] -= factor[t];
      levels[c] = median(measured(std::move(rest)));
    }
    for (std::size_t t = 0; t < runs; ++t) {
      std::vector<double> rest(rows.size());
      for (std::size_t c = 0; c < rows.size(); ++c) rest[c] = rows[c][t] - levels[c];
      factor[t] = median(measured(std::move(rest)));
    }
  }
  return factor;
}

}  // namespace

double scale_of(const std::vector<double>& series) {
  const std::vector<double> values = measured(series);
  return values.size() < 2 ? std::nan("") : std::max(min_scale, robust_standard_deviation(values));
}

std::optional<TimeChange> find_change(const std::vector<double>& series, double common_scale,
                                      const TimeRules& rules, double level) {
  const std::vector<double> values = measured(series);
  const double min_shift = std::log1p(rules.minimum_effect);
  const double min_rise = min_lambda(rises_share * level);
  const double min_fall = min_lambda((1 - rises_share) * level);
  const double normal_95 = boost::math::quantile(boost::math::normal(), 0.975);
  const std::size_t max_after = std::max<std::size_t>(14, 2 * rules.min_after);
  std::optional<TimeChange> change;
  double largest = 0;  // λ above its threshold
  std::size_t first = series.size();
  for (std::size_t n = 1; n <= max_after && n + rules.min_before <= values.size(); ++n) {
    do {
      --first;
    } while (!std::isfinite(series[first]));
    if (n < rules.min_after) continue;
    const std::vector<double> before(values.begin(), values.end() - n);
    const std::vector<double> after(values.end() - n, values.end());
    // Skips most candidates cheaply: a median is not far from the level.
    if (std::abs(median(after) - median(before)) < 0.8 * min_shift) continue;
    const Level old_level = level_before(before, common_scale);
    const Level new_level = level_of(after, old_level.scale, true);
    const double shift = new_level.value - old_level.value;
    const double error = old_level.scale * std::sqrt(1 / old_level.runs + 1 / new_level.runs);
    if (std::abs(shift) - standard_errors * error < min_shift ||
        new_level.runs < static_cast<double>(rules.min_after) - 0.5 ||
        new_level.runs < agreeing_share * static_cast<double>(n))
      continue;
    const double lambda = old_level.runs / (old_level.runs + new_level.runs) *
                          (log_likelihood(after, new_level.value, old_level.scale) -
                           log_likelihood(after, old_level.value, old_level.scale));
    const double excess = lambda - (shift > 0 ? min_rise : min_fall);
    if (excess <= largest) continue;
    largest = excess;
    change = TimeChange{first, shift, shift - normal_95 * error, shift + normal_95 * error, {}};
  }
  return change;
}

std::vector<TimeChange> find_time_changes(const TimeTable& table, const TimeRules& rules) {
  const std::size_t all_runs = table.log_kernel.size(), cases = table.log_times.size();
  const std::size_t window_start = all_runs - std::min(all_runs, time_window);
  const std::size_t runs = all_runs - window_start;
  const auto recent = [&](const std::vector<double>& series, std::size_t start) {
    std::vector<double> values(series.begin() + window_start, series.end());
    for (std::size_t t = 0; t < runs && window_start + t < start; ++t) values[t] = std::nan("");
    return values;
  };
  std::vector<std::vector<double>> rows;
  for (std::size_t c = 0; c < cases; ++c)
    rows.push_back(recent(table.log_times[c], table.starts[c]));

  const bool by_kernel = cases < min_cases;
  const std::vector<double> kernel = recent(table.log_kernel, 0);
  const std::vector<double> factor = by_kernel ? kernel : common_factor(rows, runs);
  std::vector<double> scales;
  for (std::vector<double>& row : rows) {
    for (std::size_t t = 0; t < runs; ++t) row[t] -= factor[t];
    scales.push_back(scale_of(row));
  }
  const double common_scale = median(measured(scales));

  std::vector<TimeChange> changes;
  const auto search = [&](const std::vector<double>& series, double scale,
                          std::optional<std::size_t> which) {
    const double level = rules.level_per_run / static_cast<double>(cases + 1);
    std::optional<TimeChange> change = find_change(series, scale, rules, level);
    if (!change) return;
    change->first += window_start;
    change->series = which;
    changes.push_back(*change);
  };
  for (std::size_t c = 0; c < cases; ++c) search(rows[c], common_scale, c);
  if (!by_kernel) {
    std::vector<double> against_kernel(all_runs, std::nan(""));
    for (std::size_t t = 0; t < runs; ++t) against_kernel[window_start + t] = factor[t] - kernel[t];
    against_kernel = recent(against_kernel, table.common_start);
    search(against_kernel, scale_of(against_kernel), std::nullopt);
  }
  return changes;
}

}  // namespace airybench
