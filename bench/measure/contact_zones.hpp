// How far a zone of a face reaches: where it is closed, or where it sticks.
//
// Contact points tell the end of a zone to a part of an edge. The forces tell it better: up to the
// end a of a zone the pressure falls like C √(a − s), as does μ p − |q| up to the end of one that
// sticks. Of the last edge with forces, from s₁, and the one before, from s₀, the sums P₁ and P₀ of
// these are then
//
//   P₁/(P₀ + P₁) = ((a − s₁)/(a − s₀))^(3/2)
//
// which gives a. It is taken where the last edge is in the zone from s₁ on without a gap, and the
// one before all of it; elsewhere a zone is its points, each a part of its edge. For a smooth
// pressure, and exact forces, the error of a is of the order of the square of the edges.
#pragma once

#include <vector>

namespace airybench {

struct ZoneEdge {
  double length_mm = 0;
  double force_N = 0;           // of the zone: Σ |F_n|, Σ (μ |F_n| − |F_t|)
  std::vector<bool> is_inside;  // per contact point, from start to end
};

// Per edge, mm of it in the zone, of a last one also those beyond its end. edges: of a boundary
// chain, in walking order; is_loop: the first follows the last.
std::vector<double> zone_lengths_mm(const std::vector<ZoneEdge>& edges, bool is_loop);

}  // namespace airybench
