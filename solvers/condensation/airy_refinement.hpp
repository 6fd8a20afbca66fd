// How wrong an answer in the Airy function is, as the method itself can tell; and how to mend it.
//
// With the contact forces held, everything else is linear (airy_system.hpp). Its residuals
//
//   r   = q − S x − C_Fᵀ λ − C_Cᵀ λ'    compatibility, mm
//   r_F = F − C_F x                     forces on Γ_F, N
//   r_C = F_C − F0 − C_C x              forces on Γ_C, N
//
// are formed element by element in Wide, from the mesh and not from the blocks, so that the
// blocks' own rounding is seen too; a check takes what further corrections do to them off in
// double. One more solve with the method's own factors or iterations,
//
//   ⎡ S  Cᵀ ⎤ ⎡ δx ⎤   ⎡ r        ⎤
//   ⎣ C  0  ⎦ ⎣ δλ ⎦ = ⎣ r_F, r_C ⎦,
//
// is the error of a solve to its leading digits (Higham, Accuracy and Stability of Numerical
// Algorithms, ch. 12). The estimate is the largest of
//
//   (‖δx‖_S + ‖ΔF‖_D) / ‖x‖_S          stress, in the energy norm; ΔF: see active_set.hpp
//   ‖ΔF‖_D / ‖F‖_D                      contact forces
//   ‖F − P(F − ρ r)‖ / ‖F‖              contact law, with the corrected displacements
//   ‖(r_F, r_C)‖_∞ / ‖(F, F_C)‖_∞       equilibrium on the boundary
//
// or relative to the loads where there is no stress (load_scale.hpp). ‖·‖_S is a sum over the
// elements' stresses: on slivers xᵀSx is rounding, and may be negative. Where factors are too stiff
// δx is smaller than the error e,  S e = r − Cᵀ δλ.  By Cauchy and Schwarz
//
//   |δx·(r − Cᵀ δλ)| / ‖δx‖_S ≤ ‖e‖_S,
//
// which is ‖δx‖_S for e = δx. The larger of both is taken.
//
// Refinement applies the correction, takes a Newton step of the contact law (active_set.hpp) with
// the corrected displacements, and repeats while the estimate falls.
#pragma once

#include <functional>

#include "assembly/airy_system.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// x and the multipliers; as a right-hand side r, r_F and r_C.
struct SaddleVector {
  Eigen::VectorXd x, lambda_F, lambda_C;
};
// Replaces a right-hand side by the solution of [S Cᵀ; C 0].
using SaddleSolve = std::function<void(SaddleVector&)>;

// What belongs to the solution's F_C: sets its error estimate, and says `inaccurate` where it is ok
// so far and the estimate is above the target.
void check_airy_answer(const AirySystem& system, const contact::Problem& condensed,
                       const SaddleSolve& solve, const SaddleVector& answer,
                       const RunControl& control, Solution& solution);
// For a method that has no D: with a rough diagonal (rough_compliance.hpp), the error of the
// contact forces is taken to be ten times the natural map.
void check_airy_answer_without_D(const AirySystem& system, const SaddleSolve& solve,
                                 const SaddleVector& answer, const RunControl& control,
                                 Solution& solution);

// The same after refinement of F_C, φ and stresses.
void refine_airy_answer(const AirySystem& system, const contact::Problem& condensed,
                        const SaddleSolve& solve, const SaddleVector& answer,
                        const RunControl& control, Solution& solution);

}  // namespace airybench
