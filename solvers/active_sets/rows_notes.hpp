// What a solution says of active sets on a stiffness (active_rows.hpp).
#pragma once

#include "solvers/active_sets/active_rows.hpp"

namespace airybench {

// Counts, histories and the status; `tolerance` is what was asked of them.
void note_rows(const RowsResult& rows, const ContactPoints& contact, const RunControl& control,
               double tolerance, Solution& solution);

}  // namespace airybench
