// A confidence interval of the median from order statistics, whatever the distribution.
//
// With x_(1) <= … <= x_(n) the number of samples below the median is binomial, B ~ B(n, 1/2), so
//   P( x_(j) <= median <= x_(n+1-j) ) >= 1 - 2 P(B <= j - 1),
// and j is the largest with P(B <= j - 1) <= 2.5 %. There is one from six samples on, whose
// smallest and largest are the ends: 2 · 2⁻⁶ = 3.1 %, of five 6.3 %. Le Boudec, "Performance
// Evaluation of Computer and Communication Systems", 2010, theorem 2.1. It asks for independent
// samples of one distribution; that a run goes on until it is narrow makes it somewhat too short.
#pragma once

#include <optional>
#include <vector>

#include "bench/records/bootstrap.hpp"

namespace airybench {

inline constexpr int fewest_for_median_interval = 6;

// 95 %. Empty: fewer than six samples.
std::optional<Interval> median_interval(std::vector<double> samples);

// How far the farther end of the interval is from the median, over the median: "± 2 %". Empty:
// there is no interval.
std::optional<double> median_uncertainty(const std::vector<double>& samples);

}  // namespace airybench
