// Which triangles to refine, from the parts that they have in an error.
#pragma once

#include <vector>

namespace airybench {

// The fewest triangles that hold `fraction` of the sum, largest parts first (bulk marking; Dörfler,
// SIAM J. Numer. Anal. 33, 1996); of equal parts the lower number. Ascending numbers; negative
// parts, which rounding makes, count as zero. 0 < fraction ≤ 1.
std::vector<int> bulk_marks(const std::vector<double>& parts, double fraction);

}  // namespace airybench
