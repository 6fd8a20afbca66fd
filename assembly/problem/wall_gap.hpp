// The exact gap between a straight edge of a contact face and the wall in front of it, with the
// corners, steps and ends of a wall that lie between the points of a discrete problem:
//
//   g0(s) = t_wall(x(s)) − t_face(x(s)),   x(s) = (1 − s) a + s b,   0 ≤ s ≤ 1      (wall.hpp)
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "assembly/elements/equilibrium_element.hpp"
#include "assembly/problem/wall.hpp"

namespace airybench {

// A straight edge a→b with outward normal m, its wall, and the curve that it stands for.
struct FacingEdge {
  Eigen::Vector2d a, b, m;
  const Wall& wall;
  const std::optional<Wall>& face;

  Eigen::Vector2d at(double s) const { return (1 - s) * a + s * b; }
  // Towards the wall; m if the wall defines no direction.
  Eigen::Vector2d direction_at(const Eigen::Vector2d& x) const {
    return direction_towards(wall, x).value_or(m);
  }
  // g0; none: no wall at less than 87° to m.
  std::optional<double> gap_mm(double s) const;
};

// A part of an edge on which g0 is smooth; pieces cover 0 to 1 in order.
struct GapPiece {
  double start = 0, end = 1;
  bool is_met = false;
  std::array<double, 3> gap_mm{};  // Bernstein coefficients over the piece
  double off_mm = 0;               // largest distance of g0 from them; zero except on round curves
};
std::vector<GapPiece> gap_pieces(const FacingEdge& edge);

// What a quadratic q through three points of an edge omits of the wall.
struct WallDetail {
  // A quadratic that is nowhere above g0 where a wall is met lies this much below q (Bernstein
  // coefficients): the highest in the mean of q − max (q − g0), the least g0, and the convex one
  // from g0 at one end to g0 at the other.
  std::array<double, 3> lowered_mm{0, 0, 0};
  // (n + 1)/L ∫ B_j … ds, B_j of the highest degree n of stresses; of lower degrees:
  // lower_moments().
  using Moments = std::array<double, highest_stress_degree + 1>;
  Moments moments_mm{};  // of g0 − q where a wall is met, or above
  Moments unmet{};       // of 1 where none is met

  bool is_nothing(double rounding_mm) const;
};
// q: values at start, middle and end.
WallDetail wall_detail(const std::vector<GapPiece>& pieces, const std::array<double, 3>& q);

}  // namespace airybench
