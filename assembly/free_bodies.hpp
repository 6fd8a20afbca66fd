// What a contact problem needs of the motions that contact alone holds (free_motions.hpp), where
// they are not known yet.
#pragma once

#include <functional>

#include "assembly/contact_problem.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

// Sets ContactPoints::free. degree: of the stresses or displacements, for the loads on the motions
// (work_on_free_motion()). in_frame: a motion at a point, normal and tangential, as the work
// partners of F.
void add_free_bodies(
    const Problem& problem, int degree,
    const std::function<Eigen::Vector2d(const RigidMotion& motion, int point)>& in_frame,
    ContactPoints& contact);

}  // namespace airybench
