// Methods that condense the problem on the contact boundary and then solve the contact law there.
#pragma once

#include "assembly/dual_system.hpp"
#include "solvers/condensation/condensed.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/krylov/krylov.hpp"
#include "solvers/solution.hpp"

namespace airybench {

// 3STEPD, 3STEPD:FILE, 3STEPD:LEAN: three-step condensation with the skyline LDLᵀ factorisation;
// right-hand sides in parallel.
Solution solve_three_step_skyline(const DualSystem& system, const RunControl& control,
                                  KeepX::Where where, Refine refine = Refine::no);
// 3STEPD:CHOLMOD: the same with CHOLMOD's supernodal Cholesky factorisation.
Solution solve_three_step_cholmod(const DualSystem& system, const RunControl& control);
// 3STEPCG: the same with conjugate gradients, preconditioned.
Solution solve_three_step_cg(const DualSystem& system, const RunControl& control,
                             const MakePreconditioner& make, int lanes, Refine refine);
// SYMMLQ: condensation of the whole indefinite system, preconditioned by blocks.
enum class SchurBlock { dense, sparse };
Solution solve_symmlq_condensation(const DualSystem& system, const RunControl& control,
                                   const MakePreconditioner& make, SchurBlock schur, int lanes,
                                   Refine refine);
// BLIND: blind condensation, the whole system factorised by MUMPS, a solve per contact force.
Solution solve_blind_mumps(const DualSystem& system, const RunControl& control);
// BLIND:SCHUR: the same, D from the Schur complement that MUMPS leaves.
Solution solve_blind_mumps_schur(const DualSystem& system, const RunControl& control,
                                 Refine refine = Refine::no);
// BLIND:SKY: blind condensation with the skyline LDLᵀ factorisation, multipliers numbered so that
// it needs no pivoting.
Solution solve_blind_skyline(const DualSystem& system, const RunControl& control);
// HYBRID: hybridized equilibrium elements, K_II factorised by CHOLMOD.
Solution solve_hybridized(const DualSystem& system, const RunControl& control);

// What they share: the contact law by Gauss–Seidel into the solution's forces, status, counts and
// history. Without contact points there is nothing to do and the status is ok.
void solve_condensed_contact(const CondensedSystem& condensed, const ContactPoints& contact,
                             const RunControl& control, Solution& solution);
KrylovOptions krylov_options(const RunControl& control, int lanes);
// Iterations, history and, when the tolerance was not met, status and message of a Krylov solver.
void note_krylov(const char* solver, const KrylovSummary& summary, const KrylovOptions& options,
                 const RunControl& control, Solution& solution);
// The shift that a preconditioner needed, as a parameter of the solution, and what it counts.
void note_preconditioner(const Preconditioner& preconditioner, Solution& solution);

}  // namespace airybench
