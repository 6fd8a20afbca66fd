// The statistics of comparisons.
#pragma once

#include <cstddef>
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
// and a continuity correction of 1/2. Lehmann, "Nonparametrics: Statistical Methods
// Based on Ranks", 1975, sections 1.3 and 1.4.

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

}  // namespace airybench
