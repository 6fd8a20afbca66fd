// Medians, their scale and their uncertainty.
#pragma once

#include <optional>
#include <vector>

namespace airybench {

double median(std::vector<double> values);  // NaN when empty

// MAD = median |x_i - median x|. NaN when empty.
double median_absolute_deviation(const std::vector<double>& values);

// MAD / Φ⁻¹(3/4) = 1.4826 MAD estimates the standard deviation of normal values.
// Rousseeuw, Croux, "Alternatives to the median absolute deviation", JASA 88 (1993).
double robust_standard_deviation(const std::vector<double>& values);

struct Interval {
  double low = 0, high = 0;  // high may be infinite
};

// The 95 % confidence interval of the median from order statistics x_(1) <= … <= x_(n), for any
// distribution. The number of samples below the median is binomial, B ~ B(n, 1/2), so
//   P( x_(j) <= median <= x_(n+1-j) ) >= 1 - 2 P(B <= j - 1),
// with the largest j for which P(B <= j - 1) <= 2.5 %. Empty for n < 6: the widest interval, j = 1,
// misses the median with 2 · 2⁻⁵ = 6.3 % for n = 5, and with 3.1 % for n = 6. The samples must be
// independent; repeating until the interval is narrow makes it somewhat too short. Le Boudec,
// "Performance Evaluation of Computer and Communication Systems", 2010, theorem 2.1.
std::optional<Interval> median_interval(std::vector<double> samples);
inline constexpr int fewest_for_median_interval = 6;

// max(high - median, median - low) / median. Empty without an interval.
std::optional<double> median_uncertainty(const std::vector<double>& samples);

// 95 % intervals of the percentile bootstrap: the 2.5 % and 97.5 % quantiles over 2000 resamplings
// with replacement. No sample may be empty; a single value counts as exact. Repetitions of one run
// show the uncertainty within that run only. With a fixed seed and no std:: distribution, all
// machines agree. Efron, Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13.
Interval bootstrap_median(const std::vector<double>& samples);
Interval bootstrap_ratio_of_medians(const std::vector<double>& numerator,
                                    const std::vector<double>& denominator);

}  // namespace airybench
