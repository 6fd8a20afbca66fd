// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) for S x = b, S and M symmetric
// positive definite, many right-hand sides.
//
//   r = b − S x,  z = M⁻¹ r,  p = z + β p,  α = rᵀz / pᵀS p,  x += α p,  r −= α S p
//
// Stops when √(rᵀz) ≤ tolerance · √(bᵀM⁻¹b); with M = S this is the error's energy norm.
#pragma once

#include "solvers/krylov/krylov.hpp"

namespace airybench {

inline constexpr int conjugate_gradient_vectors = 5;  // per lane: x, r, z, p, S p

// lower: lower triangle of S. Nothing is allocated inside an iteration. Throws Breakdown (pᵀS p
// not positive, rᵀz negative, or not finite), TimeoutReached.
KrylovSummary solve_by_conjugate_gradients(const SparseColumns& lower,
                                           const Preconditioner& preconditioner,
                                           const RightHandSides& sides,
                                           const KrylovOptions& options,
                                           const Deadline& deadline = {});

}  // namespace airybench
