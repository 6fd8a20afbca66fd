// The scalar in which references, residuals and signs of areas are computed: at least the 64 bits
// of mantissa of the x87, which is fast; AArch64's has 113 in software.
#pragma once

#include <limits>

namespace airybench {

using Wide = long double;
static_assert(
    std::numeric_limits<Wide>::digits >= 64,
    "references need more digits than double has: no platform without them is known to us");

}  // namespace airybench
