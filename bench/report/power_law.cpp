#include "bench/report/power_law.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {
namespace {

// Weighted sums over points, about their means.
struct Moments {
  double weight = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;  // x = log n, y = log value
};

double weight_of(const SizedValue& point, int n) {
  const double ratio = static_cast<double>(point.n) / n;
  return std::min(ratio, 1 / ratio);
}

Moments moments_of(const std::vector<SizedValue>& points, int n) {
  Moments m;
  for (const SizedValue& point : points) {
    const double w = weight_of(point, n);
    m.weight += w;
    m.mean_x += w * std::log(point.n);
    m.mean_y += w * std::log(point.value);
  }
  m.mean_x /= m.weight;
  m.mean_y /= m.weight;
  for (const SizedValue& point : points) {
    const double w = weight_of(point, n), dx = std::log(point.n) - m.mean_x;
    m.xx += w * dx * dx;
    m.xy += w * dx * (std::log(point.value) - m.mean_y);
  }
  return m;
}

bool is_of_one_size(const std::vector<SizedValue>& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const SizedValue& point) { return point.n == points.front().n; });
}

// s², where the law through the points has so many parameters of its own.
double variance_about(const Moments& m, double exponent, const std::vector<SizedValue>& points,
                      int n, std::size_t parameters, double least_scatter) {
  const double least = least_scatter * least_scatter;
  if (points.size() <= parameters) return least;
  double squares = 0;
  for (const SizedValue& point : points) {
    const double residual =
        std::log(point.value) - m.mean_y - exponent * (std::log(point.n) - m.mean_x);
    squares += weight_of(point, n) * residual * residual;
  }
  return std::max(least, squares / static_cast<double>(points.size() - parameters));
}

}  // namespace

Estimate estimate_of(double value, double scatter) {
  const double factor = std::exp(2 * scatter);
  return {value, value / factor, value * factor};
}

std::optional<Estimate> extrapolate(const std::vector<SizedValue>& points, int n,
                                    double least_scatter) {
  if (is_of_one_size(points)) return {};
  const Moments m = moments_of(points, n);
  const double exponent = m.xy / m.xx;
  const double variance = variance_about(m, exponent, points, n, 2, least_scatter);
  const double dx = std::log(n) - m.mean_x;
  return estimate_of(std::exp(m.mean_y + exponent * dx),
                     std::sqrt(variance * (1 + 1 / m.weight + dx * dx / m.xx)));
}

Estimate extrapolate(const std::vector<SizedValue>& points, int n, double exponent,
                     double least_scatter) {
  const Moments m = moments_of(points, n);
  const double dx = std::log(n) - m.mean_x;
  const double variance = variance_about(m, exponent, points, n, 1, least_scatter);
  return estimate_of(std::exp(m.mean_y + exponent * dx),
                     std::sqrt(variance * (1 + 1 / m.weight) + std::pow(exponent_scatter * dx, 2)));
}

std::optional<double> pooled_exponent(const std::vector<std::vector<SizedValue>>& groups, int n) {
  double xx = 0, xy = 0;
  for (const auto& group : groups) {
    if (is_of_one_size(group)) continue;
    const Moments m = moments_of(group, n);
    xx += m.xx;
    xy += m.xy;
  }
  if (xx == 0) return {};
  return xy / xx;
}

}  // namespace airybench
