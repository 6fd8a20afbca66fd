#include "bench/report/power_law.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

// Weighted, about the means of x = log n, y = log value.
struct Moments {
  std::size_t count;
  double weight = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;

  Moments(const std::vector<SizedValue>& points, int n) : count(points.size()) {
    const auto weight_of = [n](const SizedValue& point) {
      const double ratio = static_cast<double>(point.n) / n;
      return std::min(ratio, 1 / ratio);
    };
    for (const SizedValue& point : points) {
      const double w = weight_of(point);
      weight += w;
      mean_x += w * std::log(point.n);
      mean_y += w * std::log(point.value);
    }
    mean_x /= weight;
    mean_y /= weight;
    for (const SizedValue& point : points) {
      const double w = weight_of(point);
      const double dx = std::log(point.n) - mean_x, dy = std::log(point.value) - mean_y;
      xx += w * dx * dx;
      xy += w * dx * dy;
      yy += w * dy * dy;
    }
  }
  double variance_about(double b, std::size_t parameters, double least_scatter) const {
    const double least = least_scatter * least_scatter;
    if (count <= parameters) return least;
    const double squares = yy - 2 * b * xy + b * b * xx;  // Σ w r²
    return std::max(least, squares / static_cast<double>(count - parameters));
  }
  Estimate estimate_at(int n, double b, double variance, double variance_of_b) const {
    const double dx = std::log(n) - mean_x;
    return estimate_of(std::exp(mean_y + b * dx),
                       std::sqrt(variance * (1 + 1 / weight) + variance_of_b * dx * dx));
  }
};

bool is_of_one_size(const std::vector<SizedValue>& points) {
  return std::ranges::all_of(points,
                             [&](const SizedValue& point) { return point.n == points.front().n; });
}

}  // namespace

Estimate estimate_of(double value, double scatter) {
  const double factor = std::exp(2 * scatter);
  return {value, value / factor, value * factor};
}

std::optional<Estimate> extrapolate(const std::vector<SizedValue>& points, int n,
                                    double least_scatter) {
  if (is_of_one_size(points)) return {};
  const Moments m(points, n);
  const double exponent = m.xy / m.xx;
  const double variance = m.variance_about(exponent, 2, least_scatter);
  return m.estimate_at(n, exponent, variance, variance / m.xx);
}

Estimate extrapolate(const std::vector<SizedValue>& points, int n, double exponent,
                     double least_scatter) {
  const Moments m(points, n);
  return m.estimate_at(n, exponent, m.variance_about(exponent, 1, least_scatter),
                       exponent_scatter * exponent_scatter);
}

std::optional<double> pooled_exponent(const std::vector<std::vector<SizedValue>>& groups, int n) {
  double xx = 0, xy = 0;
  for (const auto& group : groups) {
    if (is_of_one_size(group)) continue;
    const Moments m(group, n);
    xx += m.xx;
    xy += m.xy;
  }
  if (xx == 0) return {};
  return xy / xx;
}

}  // namespace airybench
