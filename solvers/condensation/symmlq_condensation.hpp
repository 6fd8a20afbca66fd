// Condensation by SYMMLQ (the paper, section 3.2.2).
//
//        ⎡ S   Cᵀ ⎤ ⎡ φ ⎤   ⎡ q   ⎤
//   M₁₁  ⎢        ⎥ ⎢   ⎥ = ⎢ F   ⎥    C = [C_F; C_C], Λ = (λ, λ'), symmetric, indefinite
//        ⎣ C   0  ⎦ ⎣ Λ ⎦   ⎣ −F0 ⎦    (+ F_C in the last rows)
//
// λ' = G − D F_C, so the right-hand side above gives G and unit vectors in the last rows give −D:
// 1 + n_c systems. The preconditioner is
//
//   blockdiag(S*, C S*⁻¹ Cᵀ)
//
// With S* = S the preconditioned matrix has three eigenvalues (Murphy, Golub & Wathen 2000,
// doi:10.1137/S1064827599355153).
#pragma once

#include "solvers/krylov/symmlq.hpp"

namespace airybench {

SymmetricOperator saddle_operator(const AirySystem& system);
// S_star: preconditioner of S. Throws Breakdown when the Schur block is not positive definite.
Preconditioner saddle_preconditioner(const AirySystem& system, const Preconditioner& S_star,
                                     int threads, const Deadline& deadline = {});

}  // namespace airybench
