#include "meshgen/apportion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace airybench {

std::vector<int> apportion(const std::vector<double>& weights, int total) {
  const std::size_t n = weights.size();
  if (!std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0; }))
    throw std::invalid_argument("apportion: weights must be positive");
  if (total < static_cast<int>(n))
    throw std::invalid_argument("apportion: " + std::to_string(total) + " edges for " +
                                std::to_string(n) + " segments; every segment needs one");

  std::vector<int> counts(n, 0);  // 0: still shares in the rest
  int rest = total;
  double weight_of_rest = 0;
  for (bool changed = true; changed;) {
    changed = false;
    weight_of_rest = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (counts[i] == 0) weight_of_rest += weights[i];
    const double edges_per_weight = rest / weight_of_rest;
    for (std::size_t i = 0; i < n; ++i) {
      if (counts[i] == 0 && weights[i] * edges_per_weight < 1) {
        counts[i] = 1;
        --rest;
        changed = true;
      }
    }
  }

  struct Share {
    std::size_t segment;
    long long remainder;  // in units of 1e-9
  };
  std::vector<Share> shares;
  int given = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (counts[i] != 0) continue;
    const double share = rest * weights[i] / weight_of_rest;
    counts[i] = std::max(1, static_cast<int>(std::floor(share + 1e-9)));
    given += counts[i];
    shares.push_back({i, std::llround((share - counts[i]) * 1e9)});
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.remainder > b.remainder; });
  for (std::size_t k = 0; given < rest; ++k, ++given) ++counts[shares[k].segment];
  return counts;
}

}  // namespace airybench
