// Hybridized elements by active sets on K, factorised under each (factored_rows.hpp): no D. Other
// load cases of the body keep K.
#pragma once

#include "solvers/base/method.hpp"

namespace airybench {

// Throws Breakdown of bodies that contact alone holds.
Solution solve_by_active_sets(const ContactSystem& given, const RunControl& control);

}  // namespace airybench
