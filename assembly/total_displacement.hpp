// From an elastic displacement w, measured from rigid motions, to the total one of a body:
//
//   u = w + ρ      ρ: the problem's motion, those of free pieces, and the one with which points
//                  that are held have their displacements
#pragma once

#include "assembly/displacement_field.hpp"

namespace airybench {

DisplacementField with_rigid_motion(const Problem& problem, DisplacementField w);

}  // namespace airybench
