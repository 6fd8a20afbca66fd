// SSORω: with S = L + D + Lᵀ, L strictly lower triangular,
//
//   M = (D + ωL) D⁻¹ (D + ωLᵀ) / (ω(2 − ω)),   0 < ω < 2
//
// symmetric positive definite when D is. Nothing is stored: it works on the triangle of S.
// (Axelsson 1972.)
#pragma once

#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

// Keeps a reference to `lower`.
Preconditioner ssor_preconditioner(const SparseColumns& lower, double omega,
                                   const Deadline& deadline = {});

}  // namespace airybench
