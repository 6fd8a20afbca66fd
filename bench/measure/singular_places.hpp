// Vertices where the exact stress is infinite, by the exponents of wedges: a corner of more than
// 180°; where the side of a wedge is free and the other is held, from 60° on at the latest; where
// one of them is held along its normal only, as half of a wedge of twice the angle.
//
// Each has a circle around it, outside of which a largest stress is the same on every mesh. Its
// radius is a tenth of the piece's area over its perimeter, 5 % of the width of a long strip, but
// at most 5 % of the way to the piece's nearest other place.
#pragma once

#include <string>
#include <vector>

#include "assembly/contact_system.hpp"

namespace airybench {

struct SingularPlace {
  Eigen::Vector2d at_mm;
  std::string what;  // "a re-entrant corner", "the end of contact:sole"
  double within_mm;  // the circle's radius
};

// Of stresses of a degree, which follow curves or take their chords; F_C says where faces stick. In
// the order of Mesh::boundary.
std::vector<SingularPlace> singular_places(const ContactSystem& system, int degree,
                                           const Eigen::VectorXd& F_C);

}  // namespace airybench
