// Centre and scale that single outliers do not move.
#pragma once

#include <vector>

namespace airybench {

double median(std::vector<double> values);  // of an even number the middle of the two; NaN: none

// MAD = median |x_i - median x|. NaN when empty.
double median_absolute_deviation(const std::vector<double>& values);

// MAD / Φ⁻¹(3/4) = 1.4826 MAD: for normal values it estimates the standard deviation.
// Rousseeuw, Croux, "Alternatives to the median absolute deviation", JASA 88 (1993).
double robust_standard_deviation(const std::vector<double>& values);

}  // namespace airybench
