// Time and memory as a power law of the mesh size, for sizes that were not measured:
//
//   log y = a + b log n, by weighted least squares with w_i = min(n_i/n, n/n_i).
//
// The weights favour the nearest sizes, as exponents change with the size. The variance of a new
// value at n, with k points, m = Σ w_i log n_i / Σ w_i and residuals r_i, is
//
//   s² (1 + 1/Σ w_i) + (log n − m)² v,   s² = max(s_0², Σ w_i r_i² / (k − p))
//
// with p = 2 and v = s² / Σ w_i (log n_i − m)². If b is given, p = 1 and √v = 0.3, its uncertainty.
// s_0 is the scatter expected even if few points happen to lie on a line.
#pragma once

#include <optional>
#include <vector>

namespace airybench {

struct SizedValue {
  int n = 0;         // > 0
  double value = 0;  // > 0
};

// A value and its range of two standard deviations of the logarithm (about 19 of 20 cases).
struct Estimate {
  double value = 0, low = 0, high = 0;
};

// scatter: standard deviation of log(value).
Estimate estimate_of(double value, double scatter);

// Empty if the points have fewer than two different sizes.
std::optional<Estimate> extrapolate(const std::vector<SizedValue>& points, int n,
                                    double least_scatter);

// With a given exponent that may be off by exponent_scatter; for points of one size.
Estimate extrapolate(const std::vector<SizedValue>& points, int n, double exponent,
                     double least_scatter);
inline constexpr double exponent_scatter = 0.3;

// The common exponent near n of groups that differ by a factor. Empty: no group has two sizes.
std::optional<double> pooled_exponent(const std::vector<std::vector<SizedValue>>& groups, int n);

}  // namespace airybench
