// SYMMLQ (Paige & Saunders 1975, doi:10.1137/0712047) for A x = b, A symmetric and possibly
// indefinite, preconditioned by a symmetric positive definite M; many right-hand sides.
//
// Lanczos in the M⁻¹ inner product, r_k the residual-like vectors and y_k = M⁻¹ r_k:
//
//   β_k = √(r_kᵀy_k),  v_k = y_k/β_k,  α_k = v_kᵀA v_k,
//   r_{k+1} = A v_k − (β_k/β_{k−1}) r_{k−1} − (α_k/β_k) r_k        A V = R T,  T = tridiag(β, α, β)
//
// T = L̄ Q with L̄ lower triangular and Q of plane rotations; with W̄ = V Qᵀ the iterates
// x = W z,  L z = β_1 e_1, exist even where T is singular. The Galerkin ("CG") iterate differs by a
// multiple of the last column of W̄ and is taken at the end if its residual is smaller.
// Stops when ‖b − A x‖_M⁻¹ ≤ tolerance · ‖b‖_M⁻¹ by the recurrences.
#pragma once

#include "solvers/krylov/krylov.hpp"

namespace airybench {

inline constexpr int symmlq_vectors = 6;  // per lane: x, w, v, and three of the Lanczos recurrence

// A symmetric operator of order n: Y ← A X. Allocates nothing.
struct SymmetricOperator {
  Eigen::Index n = 0;
  std::function<void(const LaneBlock& X, LaneBlock& Y)> multiply;
};

// Nothing is allocated inside an iteration. Throws Breakdown (M not positive definite, or something
// not finite), TimeoutReached.
KrylovSummary solve_by_symmlq(const SymmetricOperator& A, const Preconditioner& preconditioner,
                              const RightHandSides& sides, const KrylovOptions& options,
                              const Deadline& deadline = {});

}  // namespace airybench
