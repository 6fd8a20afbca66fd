#include "bench/records/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/records/robust.hpp"

namespace airybench {
namespace {

double resampled_median(const std::vector<double>& samples, std::mt19937& engine) {
  std::vector<double> drawn;
  drawn.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    drawn.push_back(samples[engine() % samples.size()]);
  return median(std::move(drawn));
}

double resampled_ratio(const std::vector<double>& numerator, const std::vector<double>& denominator,
                       std::mt19937& engine) {
  const double above = resampled_median(numerator, engine);
  return above / resampled_median(denominator, engine);
}

// statistic(engine) computes the figure from resampled values.
template <typename Statistic>
Interval percentile_interval(const Statistic& statistic) {
  constexpr int resamples = 2000;
  std::mt19937 engine(1);
  std::vector<double> figures;
  figures.reserve(resamples);
  for (int i = 0; i < resamples; ++i) figures.push_back(statistic(engine));
  std::sort(figures.begin(), figures.end());
  constexpr int tail = resamples / 40;  // 2.5 %
  return {figures[tail], figures[resamples - 1 - tail]};
}

}  // namespace

Interval bootstrap_median(const std::vector<double>& samples) {
  return percentile_interval(
      [&](std::mt19937& engine) { return resampled_median(samples, engine); });
}

Interval bootstrap_ratio_of_medians(const std::vector<double>& numerator,
                                    const std::vector<double>& denominator) {
  return percentile_interval(
      [&](std::mt19937& engine) { return resampled_ratio(numerator, denominator, engine); });
}

}  // namespace airybench
