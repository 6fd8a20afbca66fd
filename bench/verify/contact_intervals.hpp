// Quantities of interest of a contact problem, each with an interval: resultants of the contact
// forces, the largest pressure, and the points where the contact state changes.
//
// *Resultants.* Let v be a displacement with v = 0 on Γ_D and v = n on Γ_C (or t, with friction);
// where two bodies press on each other one moves and the other does not. By virtual work the exact
// Σ F_n is ∫ σ:ε(v) − ∫ b·v − ∫_{Γ_F} f·v. With the mean m of both stresses
// (discretisation_error.hpp) instead of σ its error is at most
//
//   ‖m − σ_exact‖ ‖Aε(v)‖
//
// which is guaranteed without friction. A v with little energy is recovered from HYBRID's solution
// of the problem that prescribes it; there is none if Γ_C has several normals or meets Γ_D. The
// other intervals are estimates.
//
// *Pressure:* the largest value p of σ on Γ_C, if the peak is bounded (pressure_peak.hpp), widened
// by 2δ, δ = |p − p_u| + √(A_nnnn e_T² / |T|) + p e²/‖σ‖²: how far Aε(u) is from it, the average
// error that the triangle's e_T² allows, and what errors elsewhere change, which by virtual work is
// of the order of e². Of 336 intervals on random blocks none needed more than 1.1 δ. On a face of
// edges that are not parallel p may be that of a corner which the curve lacks: below, the largest
// mean over an edge takes its place. An interval wider than p is not given. p is nowhere exceeded:
// on an edge pressures lie below the largest of their control values, and edges are halved until
// that one is a value, to 1e-12.
//
// *Ends:* the edges of two neighbouring contact points of different states, plus one edge on each
// side.
#pragma once

#include <optional>
#include <vector>

#include "bench/verify/discretisation_error.hpp"
#include "bench/verify/pressure_peak.hpp"
#include "bench/verify/verifier.hpp"

namespace airybench {

struct Bracket {
  double low, high;
};

// Positions along a face count from its start; near the start of a closed face they may be < 0.
struct ContactEnd {
  int face = 0;  // from 0, in the order of boundary_chains()
  ContactState before, after;
  Eigen::Vector2d at_mm;  // middle of the interval
  Bracket along_face_mm{};
};

struct ContactIntervals {
  bool guaranteed = false;  // of the resultants
  std::optional<Bracket> normal_resultant_N, tangential_resultant_N;
  double largest_pressure_MPa = 0;  // of σ
  PressurePeak peak = PressurePeak::not_seen;
  std::optional<Bracket> largest_pressure_within_MPa;  // if bounded and not too wide
  std::vector<ContactEnd> ends;
};

// The displacements v of the resultants, for stresses of a degree; they do not depend on the loads.
// Empty: there is none.
struct ResultantLifts {
  std::optional<DisplacementField> normal, tangential;
};
ResultantLifts resultant_lifts(const Problem& problem, int degree);

// Empty without contact. stress, F_C and u are those that `error` was computed from.
std::optional<ContactIntervals> contact_intervals(
    const DualSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
    const DisplacementField& u, const ConstitutiveError& error, const ResultantLifts& lifts);

}  // namespace airybench
