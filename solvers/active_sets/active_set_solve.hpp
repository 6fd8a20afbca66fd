// Hybridized elements by active sets on K, factorised under each (factored_rows.hpp): no D. Other
// load cases of the body keep K.
#pragma once

#include "solvers/base/method.hpp"

namespace airybench {

// D has n_c² numbers and costs n_c³ operations: from the first of these on HYBRID does without
// where it can, above the second, 0.5 GiB, D is not formed.
inline constexpr int many_contact_unknowns = 3000, max_contact_unknowns_of_D = 8000;

// Throws Breakdown of bodies that contact alone holds.
Solution solve_by_active_sets(const ContactSystem& given, const RunControl& control);

}  // namespace airybench
