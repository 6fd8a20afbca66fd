// DTICx: drop-tolerance incomplete Cholesky factorisation as the paper has it.
//
// S = L Lᵀ, S equilibrated (unit diagonal, so every row of L has norm 1 and |L_ij| ≤ 1). Every row
// is computed from the previous rows of the *full* factor; what is below 10⁻ˣ is dropped only
// then. It is the thresholded exact factor: it cannot break down where S is positive definite to
// rounding, but costs a full factorisation in time. In memory it costs the rows within a band,
// since a row of the full factor is forgotten when no later row reaches it.
#pragma once

#include "solvers/preconditioners/preconditioner.hpp"
#include "solvers/preconditioners/triangular_solve.hpp"

namespace airybench {

IncompleteFactor drop_tolerance_factor(const SparseColumns& lower, double tolerance,
                                       const Deadline& deadline = {});

}  // namespace airybench
