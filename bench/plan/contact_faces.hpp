// The true shape of a model's contact faces, and what they just touch: what --new-scene proposes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bench/records/json.hpp"

namespace airybench {

struct Circle {
  Eigen::Vector2d centre_mm;
  double radius_mm;
};

// Vertices in mm, with the body on the left; a closed curve ends where it begins.
using Walk = std::vector<Eigen::Vector2d>;

struct FaceCurve {
  std::vector<Walk> walks;
  std::optional<Circle> circle;  // circle_of(walks)
};

// The circle on which all vertices lie, within a millionth of its radius, as those of a meshed arc
// do. None for fewer than four vertices and sides longer than 0.9 radii, which prove nothing, and
// for what is straight.
std::optional<Circle> circle_of(const std::vector<Walk>& walks);

// The circle of all these curves, if they have one in common.
std::optional<Circle> common_circle(const std::vector<FaceCurve>& curves);

// {"circle": {...}}, as a scene's "face".
Json face_on(const Circle& circle);

// A scene's "wall" that the curves just touch: a pin in a hole, a socket around a disc, else a flat
// wall against their mean outward normal.
Json wall_at(const std::vector<FaceCurve>& curves);

}  // namespace airybench
