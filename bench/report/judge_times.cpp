#include "bench/report/judge_times.hpp"

#include <algorithm>
#include <cmath>

#include "bench/records/robust.hpp"

namespace airybench {
namespace {

constexpr double rises_share = 0.9;  // a slowdown matters more than its opposite

double median_of_finite(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  return median(std::move(values));
}

// Rows: cases, of which the nights that do not count are NaN.
std::vector<double> common_factor(const std::vector<std::vector<double>>& rows,
                                  std::size_t nights) {
  constexpr int sweeps = 3;  // changes are below a tenth of a per cent then
  std::vector<double> factor(nights, 0.0), levels(rows.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t c = 0; c < rows.size(); ++c) {
      std::vector<double> rest = rows[c];
      for (std::size_t t = 0; t < nights; ++t) rest[t] -= factor[t];
      levels[c] = median_of_finite(std::move(rest));
    }
    for (std::size_t t = 0; t < nights; ++t) {
      std::vector<double> rest(rows.size());
      for (std::size_t c = 0; c < rows.size(); ++c) rest[c] = rows[c][t] - levels[c];
      factor[t] = median_of_finite(std::move(rest));
    }
  }
  return factor;
}

}  // namespace

std::size_t nights_to_judge_times(const TimeRules& rules) {
  return ChangePointRules{}.least_before + rules.least_nights_after;
}

std::vector<TimeChange> find_time_changes(const TimeTable& table, const TimeRules& rules) {
  const std::size_t all_nights = table.log_kernel.size();
  const std::size_t window_start = all_nights - std::min(all_nights, time_window);
  const std::size_t nights = all_nights - window_start, cases = table.log_times.size();
  const auto recent = [&](const std::vector<double>& series, std::size_t start) {
    std::vector<double> values(series.begin() + window_start, series.end());
    for (std::size_t t = 0; t < nights && window_start + t < start; ++t) values[t] = std::nan("");
    return values;
  };
  std::vector<std::vector<double>> rows;
  for (std::size_t c = 0; c < cases; ++c)
    rows.push_back(recent(table.log_times[c], table.starts[c]));

  const bool by_kernel = cases < least_cases;
  const std::vector<double> kernel = recent(table.log_kernel, 0);
  const std::vector<double> factor = by_kernel ? kernel : common_factor(rows, nights);
  std::vector<double> scales;
  for (std::vector<double>& row : rows) {
    for (std::size_t t = 0; t < nights; ++t) row[t] -= factor[t];
    scales.push_back(scale_of(row));
  }
  const double common_scale = median_of_finite(scales);

  ChangePointRules single;
  single.minimum_effect = rules.minimum_effect;
  single.least_after = rules.least_nights_after;
  single.most_after = std::max(single.most_after, 2 * rules.least_nights_after);
  const double level = rules.level_per_night / static_cast<double>(cases + 1);
  single.rise_level = rises_share * level;
  single.fall_level = (1 - rises_share) * level;
  std::vector<TimeChange> changes;
  const auto search = [&](const std::vector<double>& series, double scale,
                          std::optional<std::size_t> which) {
    std::optional<Change> change = find_change(series, scale, single);
    if (!change) return;
    change->first += window_start;
    changes.push_back({which, *change});
  };
  for (std::size_t c = 0; c < cases; ++c) search(rows[c], common_scale, c);
  if (!by_kernel) {
    std::vector<double> against_kernel(all_nights, std::nan(""));
    for (std::size_t t = 0; t < nights; ++t)
      against_kernel[window_start + t] = factor[t] - kernel[t];
    against_kernel = recent(against_kernel, table.common_start);
    search(against_kernel, scale_of(against_kernel), std::nullopt);
  }
  return changes;
}

}  // namespace airybench
