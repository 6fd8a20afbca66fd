// SKY: M = S, factorised in skyline storage.
#pragma once

#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

// Throws Breakdown when S is not positive definite.
Preconditioner exact_preconditioner(const SparseColumns& lower, const Deadline& deadline = {});

}  // namespace airybench
