// Augmented Lagrangian with Uzawa's algorithm (the paper, section 3.4 and Fig. 1, corrected).
//
//   L(φ, F_C, λ, λ') = ½φᵀSφ − qᵀφ + λᵀ(C_F φ − F) + λ'ᵀ(C_C φ + F0 − F_C) − ḡᵀF_C
//                      + r_F/2 ‖C_F φ − F‖² + r_C/2 ‖C_C φ + F0 − F_C‖²
//
// r_F = r p_F², r_C = r p_C², ρ alike, with p = √mean|S| / mean|C| over non-zero entries (eq. 13),
// which is what multiplying C_F and C_C by p comes to. S̃ = S + r_F C_FᵀC_F + r_C C_CᵀC_C has the
// pattern of S, since the unknowns of an edge's forces belong to one triangle. An iteration is
//
//   S̃ φ = q − C_Fᵀ(λ − r_F F) − C_Cᵀ(λ' − r_C (F_C − F0))
//   F_C ← P(C_C φ + F0 + (λ' + ḡ)/r_C)         P clips F_n to ≤ 0 first, then F_t to ±μ|F_n|
//   λ  += ρ_F (C_F φ − F),   λ' += ρ_C (C_C φ + F0 − F_C)
//
// (The paper prints "−λ'/2" in the second line, which is not the minimiser over F_C.) For a fixed
// convex set it converges for ρ < (1+√5)/2 r (Glowinski); with Coulomb's law there is no proof. ρ
// above 2r diverges.
//
// Stops:
//   paper   i_C = max(‖C_C φ + F0 − F_C‖_∞, ‖C_F φ − F‖_∞) ≤ 1e-3 N: feasibility only; the error
//           that it leaves grows with r (Mesh0, ρ = r: 6e-6 at r = 1, 5e-3 at r = 100)
//   target  ‖C_C φ + F0 − F_C‖, ‖C_F φ − F‖ ≤ tolerance · force scale, and the other residual,
//           r_C ‖F_C^{k+1} − F_C^k‖ ≤ tolerance · displacement scale
// where the scales are the largest ‖(C_F φ, C_C φ + F0, F)‖ and ‖(λ, λ')‖ so far.
#pragma once

#include <functional>
#include <vector>

#include "assembly/airy_system.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/airy_refinement.hpp"
#include "solvers/direct/skyline.hpp"

namespace airybench {

// S + Cᵀ R C, lower triangle, R diagonal over the rows of C = [C_F; C_C]. Throws Breakdown where
// contact alone holds a body.
SparseColumns penalised_matrix(const AirySystem& system, const Eigen::VectorXd& R);

struct AugmentedFactor {
  double r = 0, r_F = 0, r_C = 0;
  SkylineFactor factor;  // of S̃
};
// Throws Breakdown, TimeoutReached.
AugmentedFactor factor_augmented(const AirySystem& system, double r, const Deadline& deadline = {});

struct UzawaOptions {
  Stop stop = Stop::target;
  double tolerance = 1e-8;  // of the stop `target`, as above
  int max_iterations = 20000;
  static constexpr double paper_stop_N = 1e-3;
};

enum class UzawaOutcome { converged, too_many_iterations, diverged };

struct UzawaResult {
  double rho = 0;
  UzawaOutcome outcome = UzawaOutcome::too_many_iterations;
  int iterations = 0;
  double primal_N = 0;               // i_C at the end
  double primal = 0, dual = 0;       // relative residuals of the stop `target`, at the end
  Eigen::VectorXd F_C, x;            // the contact forces and the scaled Airy unknowns
  Eigen::VectorXd lambda, lambda_c;  // λ, λ'
  std::vector<double> history;  // max(primal, dual), or i_C for the paper's stop; one per iteration
};

// Of the iterates and results of `count` values of ρ.
std::size_t uzawa_bytes(const AirySystem& system, int count);

// One iteration for every ρ, side by side: they share the reading of the factor. race: the others
// are given up when the first converges, and no solutions and histories are kept. Nothing is
// allocated inside an iteration, but for histories and bodies that press on each other. Throws
// TimeoutReached.
std::vector<UzawaResult> iterate_uzawa(const AirySystem& system, const AugmentedFactor& augmented,
                                       const std::vector<double>& rhos, const UzawaOptions& options,
                                       bool race = false, const Deadline& deadline = {});

// S̃ = S + Cᵀ R C as a function, solve: x ← S̃⁻¹ x.
struct PenalisedSolve {
  Eigen::VectorXd R;
  std::function<void(Eigen::VectorXd& x)> solve;
  double tolerance = 1e-4;  // of solve_saddle, the residual's over the first one's
};
// Refers to the factor.
PenalisedSolve penalised_solve(const AirySystem& system, const AugmentedFactor& augmented);

// Solves [S Cᵀ; C 0] for any right-hand side, in place, by conjugate gradients on C S̃⁻¹ Cᵀ, to a
// relative residual. False where that is not reached in 500 iterations.
bool solve_saddle(const AirySystem& system, const PenalisedSolve& penalised, SaddleVector& v,
                  const Deadline& deadline = {});

UzawaOptions uzawa_options(const RunControl& control);

// From the end of an iteration to the solution: φ, stresses, status, and the check. parameters: for
// the record and for messages. penalised: for the check's conjugate gradients.
void store_uzawa_answer(const AirySystem& system, const RunControl& control,
                        const PenalisedSolve& penalised, const std::string& parameters,
                        UzawaResult result, Solution& solution);

}  // namespace airybench
