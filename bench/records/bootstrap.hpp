// Percentile bootstrap: how uncertain a median, or a ratio of medians, is.
//
// Every sample is replaced by as many draws from it, with replacement, 2000 times; the interval is
// between the 2.5 % and 97.5 % quantiles of what is computed from them. Efron, Tibshirani, "An
// Introduction to the Bootstrap", 1993, section 13. Of a run's repetitions it is the
// uncertainty within that run: what changes from run to run is not in it. One value alone is taken
// as exact.
//
// The seed is fixed, and only the engine's own numbers are used: equal on every machine.
#pragma once

#include <vector>

namespace airybench {

struct Interval {
  double low = 0, high = 0;  // high may be infinite
};

// 95 %. No sample may be empty.
Interval bootstrap_median(const std::vector<double>& samples);
Interval bootstrap_ratio_of_medians(const std::vector<double>& numerator,
                                    const std::vector<double>& denominator);

}  // namespace airybench
