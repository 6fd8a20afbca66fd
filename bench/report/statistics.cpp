#include "bench/report/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <numeric>

namespace airybench {
namespace {

constexpr std::size_t max_for_exact = 25;  // C(50, 25) < 2^53: the counts are exact in doubles

// N(u; m, n) for u = 0 .. m n.
std::vector<double> orderings(std::size_t m, std::size_t n) {
  std::vector<double> counts(m * n + 1, 0.0);
  counts[0] = 1;
  for (std::size_t i = 1; i <= m; ++i) {
    for (std::size_t u = m * n; u >= n + i; --u) counts[u] -= counts[u - n - i];  // (1 - q^(n+i))
    for (std::size_t u = i; u <= m * n; ++u) counts[u] += counts[u - i];          // / (1 - q^i)
  }
  return counts;
}

double exact_p(double u, std::size_t m, std::size_t n) {
  const std::vector<double> counts = orderings(m, n);
  const auto extreme = static_cast<std::size_t>(std::min(u, static_cast<double>(m * n) - u));
  const double tail = std::accumulate(counts.begin(), counts.begin() + extreme + 1, 0.0);
  return std::min(1.0, 2 * tail / std::accumulate(counts.begin(), counts.end(), 0.0));
}

// Σ (t³ - t) over the groups of equal values.
double tie_sum(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (auto first = values.begin(); first != values.end();) {
    const auto last = std::upper_bound(first, values.end(), *first);
    const auto t = static_cast<double>(last - first);
    sum += t * t * t - t;
    first = last;
  }
  return sum;
}

double normal_p(double u, double m, double n, double ties) {
  const double all = m + n;
  if (all < 2) return 1;
  const double variance = m * n / 12 * (all + 1 - ties / (all * (all - 1)));
  const double distance = std::abs(u - m * n / 2) - 0.5;
  if (!(variance > 0) || distance <= 0) return 1;
  const boost::math::normal standard;
  return 2 * boost::math::cdf(complement(standard, distance / std::sqrt(variance)));
}

}  // namespace

MannWhitney mann_whitney(const std::vector<double>& a, const std::vector<double>& b) {
  MannWhitney result;
  for (const double x : a)
    for (const double y : b) result.u += x < y ? 1 : x == y ? 0.5 : 0;
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const double ties = tie_sum(std::move(all));
  result.exact = ties == 0 && std::max(a.size(), b.size()) <= max_for_exact;
  result.p = result.exact ? exact_p(result.u, a.size(), b.size())
                          : normal_p(result.u, static_cast<double>(a.size()),
                                     static_cast<double>(b.size()), ties);
  return result;
}

double min_mann_whitney_p(std::size_t m, std::size_t n) {
  // 1 / C(m + n, m) = (m + n + 1) B(m + 1, n + 1), which does not overflow.
  const auto a = static_cast<double>(m) + 1, b = static_cast<double>(n) + 1;
  return std::min(1.0, 2 * (a + b - 1) * boost::math::beta(a, b));
}

std::size_t values_needed_for(double level) {
  std::size_t values = 1;
  while (min_mann_whitney_p(values, values) > level) ++values;
  return values;
}

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double p = static_cast<double>(order.size() - k) * p_values[order[k]];
    largest = std::max(largest, std::min(1.0, p));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

}  // namespace airybench
