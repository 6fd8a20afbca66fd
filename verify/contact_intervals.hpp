// Quantities of interest of a contact problem, each with an interval: resultants of the contact
// forces, the largest pressure, and the points where the contact state changes.
//
// *Resultants*, of a face and of all together, by virtual work with a displacement v that singles
// them out (resultant_lifts.hpp). With the mean m of both stresses (discretisation_error.hpp)
// instead of the exact one the work is off by at most
//
//   ‖m − σ_exact‖ ‖Aε(v)‖
//
// which is guaranteed without friction. A v with little energy is recovered from HYBRID's solution
// of the problem that prescribes it; there is none if v would jump: where a face meets
// what is held or, with friction, has a corner. On curves, where v = n is interpolated, the
// interval is widened by how far the work of σ is from Σ F_n, which is only rounding elsewhere. The
// other intervals are estimates.
//
// *Pressure:* the largest value p of σ on Γ_C, if the peak is bounded (pressure_peak.hpp), widened
// by 2δ, δ = |p − p_u| + √(A_nnnn e_T² / |T|) + p e²/‖σ‖²: how far Aε(u) is from it, the average
// error that the triangle's e_T² allows, and what errors elsewhere change, which by virtual work is
// of the order of e², here with the p of all faces. Of 336 intervals on random blocks none needed
// more than 1.1 δ. On a face of edges that are not parallel p may be that of a corner which the
// curve lacks: below, the largest mean over an edge takes its place. An interval wider than p is
// not given. p is nowhere exceeded: on an edge pressures lie below the largest of their control
// values, and edges are halved until that one is a value, to 1e-12.
//
// *Ends:* the edges of two neighbouring contact points of different states, plus one edge on each
// side.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mesh/boundary_sides.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/pressure_peak.hpp"
#include "verify/resultant_lifts.hpp"
#include "verify/verifier.hpp"

namespace airybench {

struct Bracket {
  double low, high;
};

// Positions along a face count from its start; near the start of a closed face they may be < 0.
// 2δ, MPa, of a largest value of σ that lies in a triangle, as of the pressure above. difference:
// from that of Aε(u); stiffness: the largest square of such a value for σ:C:σ = 1; far: the size of
// what errors elsewhere change.
double twice_estimated_error_MPa(const Problem& problem, const ConstitutiveError& error,
                                 int triangle, double stiffness_MPa, double difference_MPa,
                                 double far_MPa);

struct ContactEnd {
  int face = 0;  // from 0, in the order of boundary_chains()
  ContactState before, after;
  Eigen::Vector2d at_mm;  // middle of the interval
  Bracket along_face_mm{};
};

struct FaceIntervals {
  std::optional<Bracket> normal_resultant_N, tangential_resultant_N;
  double largest_pressure_MPa = 0;  // of σ
  Eigen::Vector2d largest_pressure_at_mm = {0, 0};
  PressurePeak peak = PressurePeak::not_seen;
  std::optional<Bracket> largest_pressure_within_MPa;  // if bounded and not too wide
};

// Those of all faces together.
struct ContactIntervals : FaceIntervals {
  bool guaranteed = false;           // of the resultants
  std::vector<FaceIntervals> faces;  // of ResultantLifts::faces
  std::vector<ContactEnd> ends;
};

// Empty without contact. stress, F_C and u are those that `error` was computed from.
std::optional<ContactIntervals> contact_intervals(
    const ContactSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
    const DisplacementField& u, const ConstitutiveError& error, const ResultantLifts& lifts);

struct LargestPressure {
  double pressure_MPa = -std::numeric_limits<double>::infinity();
  double of_edge_MPa = pressure_MPa;  // the largest mean over an edge
  Eigen::Vector2d at_mm = {0, 0};
  int triangle = 0;
  Eigen::Vector2d normal = {0, 0};
};
// On those edges of Γ_C that are asked for, per row of Mesh::boundary; sides: boundary_sides().
LargestPressure largest_pressure(const Problem& problem, const StressField& stress,
                                 const std::vector<bool>& asked,
                                 const std::vector<TriangleSide>& sides);

}  // namespace airybench
