#include "bench/report/multiple_testing.hpp"

#include <algorithm>
#include <numeric>

namespace airybench {

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return p_values[i] < p_values[j]; });
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
