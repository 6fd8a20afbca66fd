// The scalar in which references, residuals and signs of areas are computed: at least 64 bits of
// mantissa. The long double of x86 has them and is fast; elsewhere it is a double, or computed in
// software, and two doubles are faster.
#pragma once

#include <cfloat>
#include <limits>

#include "support/double_double.hpp"

namespace airybench {

#if LDBL_MANT_DIG == 64 && !defined(AIRYBENCH_DOUBLE_DOUBLE)
using Wide = long double;
#else
using Wide = DoubleDouble;
#endif
static_assert(std::numeric_limits<Wide>::digits >= 64);

}  // namespace airybench
