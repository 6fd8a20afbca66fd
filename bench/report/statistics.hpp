// The statistics of comparisons and predictions.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace airybench {

// The Mann-Whitney (Wilcoxon rank sum) test: is one of two samples shifted against the other?
//
//   U = #{(i, j): a_i < b_j} + ½ #{(i, j): a_i = b_j},   0 <= U <= m n,   E U = m n / 2
//
// Mann, Whitney, Ann. Math. Statist. 18 (1947) 50-60. Without ties and up to 25 values per side p
// is exact; the number of orderings with U = u is
//   N(u; m, n) = coefficient of q^u in Π_{i=1..m} (1 - q^(n+i)) / (1 - q^i),
// the Gaussian binomial. Otherwise U is taken as normal, with
//   Var U = m n / 12 [ N + 1 - Σ (t³ - t) / (N (N - 1)) ],   N = m + n, t: sizes of the ties,
// and a continuity correction of 1/2. Lehmann, "Nonparametrics", 1975, section 1.5.

struct MannWhitney {
  double u = 0;  // > m n / 2: b is larger
  double p = 1;  // two-sided
  bool exact = false;
};

// p = 1 for two empty or constant samples.
MannWhitney mann_whitney(const std::vector<double>& a, const std::vector<double>& b);

// 2 / C(m + n, m), the least possible p.
double min_mann_whitney_p(std::size_t m, std::size_t n);
// Values per side from which p <= level is possible; 0 < level <= 1.
std::size_t values_needed_for(double level);

// Holm's step-down adjustment, in the order of p_values: the k-th smallest (from 1) of n becomes
//   max over i <= k of min(1, (n - i + 1) p_(i)).
// Rejecting where it is <= α keeps the family-wise error rate at α under any dependence. Holm,
// Scand. J. Statist. 6 (1979) 65-70.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

// Time and memory as a power law of the mesh size, for sizes that were not measured:
//
//   log y = a + b log n, by weighted least squares with w_i = min(n_i/n, n/n_i).
//
// The weights favour the nearest sizes. The variance of a new value at n, with k points, m = Σ w_i
// log n_i / Σ w_i and residuals r_i, is
//
//   s² (1 + 1/Σ w_i) + (log n − m)² v,   s² = max(s_0², Σ w_i r_i² / (k − p))
//
// with p = 2 and v = s² / Σ w_i (log n_i − m)². If b is given, p = 1 and √v = 0.3, its uncertainty.
// s_0 is the scatter expected even if few points happen to lie on a line.
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
                                    double min_scatter);

// With a given exponent that may be off by exponent_scatter; for points of one size.
Estimate extrapolate(const std::vector<SizedValue>& points, int n, double exponent,
                     double min_scatter);
inline constexpr double exponent_scatter = 0.3;

// The common exponent near n of groups that differ by a factor. Empty: no group has two sizes.
std::optional<double> pooled_exponent(const std::vector<std::vector<SizedValue>>& groups, int n);

}  // namespace airybench
