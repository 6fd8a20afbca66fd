#include "bench/report/mann_whitney.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>

namespace airybench {
namespace {

constexpr std::size_t most_for_exact = 25;  // C(50, 25) < 2^53: the counts are exact in doubles

// N(u; m, n) for u = 0 .. m n, by the recursion over m for all sizes up to n.
std::vector<double> orderings(std::size_t m, std::size_t n) {
  std::vector<std::vector<double>> counts(n + 1, {1.0});  // of no a: U = 0
  for (std::size_t i = 1; i <= m; ++i) {
    std::vector<std::vector<double>> next(n + 1, {1.0});  // of no b: U = 0
    for (std::size_t j = 1; j <= n; ++j) {
      std::vector<double> row(i * j + 1, 0.0);
      // The largest value is of a: it is below no b, U comes from the other i - 1 and all j.
      for (std::size_t u = 0; u < counts[j].size(); ++u) row[u] += counts[j][u];
      // The largest value is of b: it is above all i.
      for (std::size_t u = 0; u < next[j - 1].size(); ++u) row[u + i] += next[j - 1][u];
      next[j] = std::move(row);
    }
    counts = std::move(next);
  }
  return counts[n];
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
  result.exact = ties == 0 && std::max(a.size(), b.size()) <= most_for_exact;
  result.p = result.exact ? exact_p(result.u, a.size(), b.size())
                          : normal_p(result.u, static_cast<double>(a.size()),
                                     static_cast<double>(b.size()), ties);
  return result;
}

double least_mann_whitney_p(std::size_t m, std::size_t n) {
  // 2 / (m + n over m); by logarithms, as the coefficient overflows from about a thousand on.
  const auto log_factorial = [](std::size_t k) {
    return boost::math::lgamma(static_cast<double>(k) + 1);
  };
  return std::min(1.0, 2 * std::exp(log_factorial(m) + log_factorial(n) - log_factorial(m + n)));
}

std::size_t values_needed_for(double level) {
  std::size_t values = 1;
  while (least_mann_whitney_p(values, values) > level) ++values;
  return values;
}

}  // namespace airybench
