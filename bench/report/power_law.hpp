// Time and memory over the size of the mesh as a power law, for sizes that were not measured.
//
//   log y = a + b log n, by weighted least squares with w_i = min(n_i/n, n/n_i):
//
// exponents change with the size, and the nearest sizes tell most. The variance of a new value at
// n, with k points, m = Σ w_i log n_i / Σ w_i and residuals r_i, is
//
//   s² (1 + 1/Σ w_i) + (log n − m)² v,   s² = max(s_0², Σ w_i r_i² / (k − p))
//
// with p = 2 and v = s² / Σ w_i (log n_i − m)²; where b is known, p = 1 and √v = 0.3, by which b
// may be off. s_0 is the scatter to be expected even if few points happen to lie on a line.
#pragma once

#include <optional>
#include <vector>

namespace airybench {

struct SizedValue {
  int n = 0;         // > 0
  double value = 0;  // > 0
};

// A value and where it lies in about 19 of 20 cases (two standard deviations of its logarithm).
struct Estimate {
  double value = 0, low = 0, high = 0;
};

// The estimate of a value whose logarithm has this standard deviation.
Estimate estimate_of(double value, double scatter);

// The power law at n. Empty when the points have fewer than two different sizes.
std::optional<Estimate> extrapolate(const std::vector<SizedValue>& points, int n,
                                    double least_scatter);

// With an exponent from elsewhere that may be off by exponent_scatter; for points of one size.
Estimate extrapolate(const std::vector<SizedValue>& points, int n, double exponent,
                     double least_scatter);
inline constexpr double exponent_scatter = 0.3;

// The common exponent near n of groups with a factor each. Empty: no group has two different sizes.
std::optional<double> pooled_exponent(const std::vector<std::vector<SizedValue>>& groups, int n);

}  // namespace airybench
