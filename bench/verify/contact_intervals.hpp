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
// *Pressure:* the largest values of σ and Aε(u) on Γ_C, widened on both sides by δ = √(A_nnnn e_T²
// / |T|) + p e²/‖σ‖²: the average error that the triangle's e_T² allows, and what errors elsewhere
// change, which by virtual work is of the order of e². The pressure p of σ is nowhere exceeded: on
// an edge pressures lie below the largest of their control values, and edges are halved until that
// one is a value, to 1e-12. An infinite pressure, at the edge of a punch or a kink of a wall,
// has no interval. It shows in the mean pressure over windows of 1, 2, 4 and 8 edge lengths around
// the peak. With each halving of the window the mean grows: at a smooth peak by a quarter of the
// step before, at a √x cusp by 0.7 of it, at a log x peak by as much, at an x^−α peak by more.
// Windows longer than the closed part around the peak tell nothing.
//
// *Ends:* the edges of two neighbouring contact points of different states, plus one edge on each
// side.
#pragma once

#include <optional>
#include <vector>

#include "bench/verify/discretisation_error.hpp"
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
  double largest_pressure_MPa = 0;                                         // of σ
  enum class Peak { bounded, unbounded, not_seen } peak = Peak::not_seen;  // not seen: few edges
  std::optional<Bracket> largest_pressure_within_MPa;                      // if bounded
  std::vector<ContactEnd> ends;
};

constexpr const char* name_of(ContactIntervals::Peak peak) {
  constexpr std::array<const char*, 3> names = {"bounded", "unbounded", "not seen"};
  return names[static_cast<std::size_t>(peak)];
}

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
