// Gauss–Seidel with Anderson acceleration (anderson_acceleration.hpp): g(F) is one sweep
// (gauss_seidel.hpp), f = g(F) − F.
#pragma once

#include "solvers/contact/condensed.hpp"

namespace airybench {

ContactResult solve_contact_by_anderson(const contact::Problem& problem,
                                        const ContactOptions& options = {},
                                        const Deadline& deadline = {});

}  // namespace airybench
