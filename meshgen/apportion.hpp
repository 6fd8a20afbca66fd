// Largest-remainder apportionment of whole edges to weighted segments.
#pragma once

#include <vector>

namespace airybench {

// Whole numbers n_i >= 1 with Σ n_i = total, as near to total·w_i/Σw as the largest-remainder rule
// brings them; a segment whose share is below one gets one and leaves the rest to the others. Equal
// remainders (to 1e-9) go to the earlier segment. Requires w_i > 0 and total >= their number;
// otherwise throws std::invalid_argument.
std::vector<int> apportion(const std::vector<double>& weights, int total);

}  // namespace airybench
