// What a solution says of its contact points.
#pragma once

#include <optional>
#include <vector>

#include "assembly/displacement_field.hpp"
#include "bench/verify/verifier.hpp"

namespace airybench {

// Per contact point of the system, two per edge, in Problem::frame_of_moment(). Gap and slip are
// what the contact law has: moments over the edge (edge_forces.hpp), a gap of zero where it is
// closed and a slip of zero where it sticks, from the load step before.
struct ContactPicture {
  std::vector<Eigen::Vector2d> force;  // normal, tangential, N
  std::vector<ContactState> state;
  std::vector<double> gap_mm;   // g0 − u_n
  std::vector<double> slip_mm;  // u_t against the wall; empty: not known
};

// A displacement method: the tractions of its stresses, the states of its control points. w: a
// displacement of the solution without the problem's rigid motion, where there is one.
ContactPicture contact_picture(const DualSystem& system, const Solution& solution,
                               const std::optional<DisplacementField>& w);

}  // namespace airybench
