// Medians: their scale, and how uncertain they are.
#pragma once

#include <optional>
#include <vector>

namespace airybench {

double median(std::vector<double> values);  // of an even number the middle of the two; NaN: none

// MAD = median |x_i - median x|. NaN when empty.
double median_absolute_deviation(const std::vector<double>& values);

// MAD / Φ⁻¹(3/4) = 1.4826 MAD: for normal values it estimates the standard deviation.
// Rousseeuw, Croux, "Alternatives to the median absolute deviation", JASA 88 (1993).
double robust_standard_deviation(const std::vector<double>& values);

struct Interval {
  double low = 0, high = 0;  // high may be infinite
};

// A 95 % confidence interval of the median from order statistics, whatever the distribution: with
// x_(1) <= … <= x_(n) the number of samples below the median is binomial, B ~ B(n, 1/2), so
//   P( x_(j) <= median <= x_(n+1-j) ) >= 1 - 2 P(B <= j - 1),
// and j is the largest with P(B <= j - 1) <= 2.5 %. Empty: fewer than six samples; of six the
// smallest and largest are the ends, 2 · 2⁻⁶ = 3.1 %, of five that would be 6.3 %. Le Boudec,
// "Performance Evaluation of Computer and Communication Systems", 2010, theorem 2.1. It asks for
// independent samples of one distribution; a run that goes on until it is narrow makes it somewhat
// too short.
std::optional<Interval> median_interval(std::vector<double> samples);
inline constexpr int fewest_for_median_interval = 6;

// How far the farther end of the interval is from the median, over the median: "± 2 %". Empty:
// there is no interval.
std::optional<double> median_uncertainty(const std::vector<double>& samples);

// The percentile bootstrap's 95 % interval, also for fewer samples and for ratios: every sample is
// replaced by as many draws from it, with replacement, 2000 times; the interval is between the
// 2.5 % and 97.5 % quantiles of the results. Efron, Tibshirani, "An Introduction to the Bootstrap",
// 1993, section 13. Of a run's repetitions it is the uncertainty within that run. One value alone
// is taken as exact; no sample may be empty. The seed is fixed, and only the engine's own numbers
// are used: equal on every machine.
Interval bootstrap_median(const std::vector<double>& samples);
Interval bootstrap_ratio_of_medians(const std::vector<double>& numerator,
                                    const std::vector<double>& denominator);

}  // namespace airybench
