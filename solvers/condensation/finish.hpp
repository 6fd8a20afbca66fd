// What every condensation ends with, D and G being there:
//
//   contact   the contact forces, by the contact law on ū_C = D F_C − G, and free motions, which
//             then stand in the condensed problem's gap
//   recover   from them φ or u, and the stresses
//   check     the method's own estimate of its error, by one more solve; refinement
//
// and what another load case of the same body then begins with (kept_body.hpp): D stays, G is new.
#pragma once

#include <functional>
#include <memory>

#include "solvers/condensation/airy_refinement.hpp"
#include "solvers/condensation/stiffness_check.hpp"
#include "solvers/contact/condensed.hpp"

namespace airybench {

enum class Refine { no, yes };

// SaddleSolve with the matrices of the load case at hand, which are those of the first.
using BodySolve = std::function<void(const AirySystem&, SaddleVector&)>;

// Of a method in the Airy function. recover: x and the multipliers that belong to F_C. solve: for
// any right-hand side. owner: of all that `solve` refers to; without one no body is kept.
//
// Other load cases need no more than D and `solve`:  [S Cᵀ; C 0] (x, λ, λ') = (q, F, F_C − F0)  has
// λ' = G for F_C = 0, and is the recovery for the F_C found.
void finish_in_airy_function(const AirySystem& system, const RunControl& control,
                             contact::Problem& condensed,
                             const std::function<SaddleVector(const Eigen::VectorXd& F_C)>& recover,
                             const BodySolve& solve, Refine refine, Solution& solution,
                             std::shared_ptr<const void> owner = nullptr);

// φ and stresses into the solution.
void store_airy_answer(const AirySystem& system, const Eigen::VectorXd& x, Solution& solution);

// Of a method in displacements. recover: the stresses of the displacements u into the solution.
// unbalanced: the forces that these and F_C leave.
void finish_in_displacements(const Problem& problem, const RunControl& control,
                             contact::Problem& condensed, StiffnessFactor& factor,
                             const std::function<void(Eigen::VectorXd u)>& recover,
                             const std::function<UnbalancedForces()>& unbalanced,
                             Solution& solution);

}  // namespace airybench
