// What one asks of a contact problem, each with an interval: resultants of the contact forces, the
// largest pressure, where points of one state end and those of another begin.
//
// *Resultants.* Let v be a displacement that is 0 on Γ_D and n on Γ_C (or t, with friction). By
// virtual work Σ F_n of the exact stress is ∫ σ:ε(v) − ∫ b·v − ∫_{Γ_F} f·v; with the mean m of both
// stresses (discretisation_error.hpp) in its place it is off by at most
//
//   ‖m − σ_exact‖ ‖Aε(v)‖
//
// which is guaranteed where the bound of the mean is: without friction. Any v will do; the one with
// little energy is recovered from HYBRID's answer to the problem that prescribes it. There is none
// where Γ_C has several normals or meets Γ_D.
//
// The others are estimates. *Pressure:* its largest value at contact points by σ and by Aε(u), and
// beyond both δ with δ² = A_nnnn e_T² / |T|, what e_T² of the triangle there allows for on average.
// At the edge of a punch or a kink of a wall the exact pressure is infinite, and there is no such
// interval: it is told from the mean pressure over windows of 1, 2, 4 … edge lengths about the
// peak. Towards the peak each doubles the detail: at a smooth one the mean grows by a quarter of
// the step before, at a cusp as √x by 0.7, where it grows as log x by as much, as x^−α by more.
// *Ends:* between two contact points of different states, an edge more on each side.
#pragma once

#include <optional>
#include <vector>

#include "bench/verify/discretisation_error.hpp"
#include "bench/verify/verifier.hpp"

namespace airybench {

struct Bracket {
  double low, high;
};

// Along a contact face as its boundary is walked, from its start; an interval around the start of a
// closed face begins below zero.
struct ContactEnd {
  int face = 0;  // from 0, in the order of boundary_chains()
  ContactState before, after;
  Eigen::Vector2d at_mm;  // in the middle of the interval
  Bracket along_face_mm{};
};

struct ContactIntervals {
  bool guaranteed = false;  // the resultants'
  std::optional<Bracket> normal_resultant_N, tangential_resultant_N;
  double largest_pressure_MPa = 0;                                         // of σ
  enum class Peak { bounded, unbounded, not_seen } peak = Peak::not_seen;  // not seen: few edges
  std::optional<Bracket> largest_pressure_within_MPa;                      // of a bounded one
  std::vector<ContactEnd> ends;
};

constexpr const char* name_of(ContactIntervals::Peak peak) {
  constexpr std::array<const char*, 3> names = {"bounded", "unbounded", "not seen"};
  return names[static_cast<std::size_t>(peak)];
}

// The displacements v of a body that the resultants are found by, whatever its loads. Empty: there
// are none.
struct ResultantLifts {
  std::optional<DisplacementField> normal, tangential;
};
ResultantLifts resultant_lifts(const Problem& problem);

// Empty without contact. stress, F_C, u: what `error` has been made of.
std::optional<ContactIntervals> contact_intervals(
    const DualSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
    const DisplacementField& u, const ConstitutiveError& error, const ResultantLifts& lifts);

}  // namespace airybench
