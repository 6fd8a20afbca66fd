// The augmented Lagrangian of augmented_lagrangian.hpp without parameters to choose: ρ = r, a
// penalty for every row that the matrix itself gives, and Anderson acceleration.
//
// With ρ = r an iteration is a map of one vector v over the rows of C = [C_F; C_C], N (it is
// Douglas–Rachford splitting; Eckstein & Bertsekas 1992, doi:10.1007/BF01581204):
//
//   Z = P(v)                           F on Γ_F; on Γ_C the projection of v + ḡ/R
//   λ = R (v − Z)                      multipliers, mm
//   S̃ φ = q − Cᵀ (λ − R (Z − F0)),     S̃ = S + Cᵀ R C
//   g(v) = C φ + F0 + v − Z
//
// v = g(v) is the solution: C φ + F0 = Z obeys P, and λ belongs to it. Near it P is linear, g is,
// and Anderson's method (anderson_acceleration.hpp, in the norm of √R) converges as a Krylov method
// does; where P's pieces change it falls back on plain steps.
//
// R_i = w / Σ_k C_ik². S has a unit diagonal, so that this is w / (C diag(S)⁻¹ Cᵀ)_ii, which like
// the compliance D_ii of the body at an edge depends on the material only, not on the edge's size.
// Plain steps want R ~ √(λ_min λ_max) of D (Ghadimi, Teixeira, Shames & Johansson 2015,
// doi:10.1109/TAC.2014.2354892). Accelerated ones want R ~ D_ii, within a factor of 3: w = 3 on
// Γ_C. Where forces are prescribed there is no law to find, and w may be larger; beyond 300 the
// digits of S̃ are lost in its penalties.
//
// The stop `target` is primal as iterate_uzawa's, and dual ‖P(g) − P(v)‖ ≤ tolerance · ‖C_C φ +
// F0‖, the natural map with R for 1/ρ. Where the residual has not fallen for 200 iterations and is
// within 100 times the tolerance, it is at rounding; the check then judges the answer.
#pragma once

#include "solvers/direct/cholmod.hpp"
#include "solvers/uzawa/augmented_lagrangian.hpp"

namespace airybench {

struct PenalisedFactor {
  Eigen::VectorXd R;     // per row of C, mm/N
  CholmodFactor factor;  // of S̃
};

// R of the rows. weight_C: w on Γ_C; weight_F: where forces are prescribed.
Eigen::VectorXd row_penalties(const AirySystem& system, double weight_F, double weight_C);

// The vectors of its iteration.
std::size_t accelerated_bytes(const AirySystem& system);

// Nothing of the system's size is allocated inside an iteration, but for histories. Not const:
// `penalised.factor` has its own workspace. Throws TimeoutReached.
UzawaResult iterate_accelerated(const AirySystem& system, PenalisedFactor& penalised,
                                const UzawaOptions& options, const Deadline& deadline = {});

}  // namespace airybench
