// Hybridized elements by active sets on K, factorised under each (factored_rows.hpp): no D. Other
// load cases of the body keep K.
#pragma once

#include "solvers/base/method.hpp"

namespace airybench {

// D has n_c² numbers, above this 0.5 GiB: it is not formed.
inline constexpr int max_contact_unknowns_of_D = 8000;
// Whether active sets, some 20 factorisations of K, take less than D, n_c³ operations and at least
// a second.
bool active_sets_cost_less_than_D(const ContactSystem& given);

// Throws Breakdown of bodies that contact alone holds.
Solution solve_by_active_sets(const ContactSystem& given, const RunControl& control);

}  // namespace airybench
