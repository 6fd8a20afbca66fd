// What rigid bodies do under their loads when they are let go (rigid_contact.hpp): the motion q and
// forces F at the ends of contact edges with
//
//   M q = l + Nᵀ F,   r = N q:   r_n ≤ ε g, F_n ≤ 0, and Coulomb's law
//
// in the limit ε → 0 of small gaps g. q = 0: contact can hold the bodies. As a complementarity
// problem it always has a solution (Anitescu & Potra 1997, doi:10.1023/A:1008292328909):
//
//   ε g − r_n ≥ 0 ⊥ −F_n ≥ 0,   λ ± r_t ≥ 0 ⊥ β± ≥ 0,   −μ F_n − β₊ − β₋ ≥ 0 ⊥ λ ≥ 0,
//   F_t = β₊ − β₋
//
// It is solved on the ends that bodies would pass otherwise, which are few.
#pragma once

#include <optional>
#include <string>

#include "assembly/rigid_contact.hpp"

namespace airybench {

struct ReleasedBodies {
  Eigen::VectorXd q;             // per motion; a scale is not meant
  Eigen::VectorXd unbalanced_N;  // M q
  Eigen::VectorXd pressing_N;    // per end, −F_n
  bool are_held = false;         // M q is rounding
};
// None: no solution was found.
std::optional<ReleasedBodies> release(const RigidContact& contact);

// "nothing holds the body block: it slides along (0.94, -0.342), with 2.47 N of its loads
// unbalanced". Of bodies that are held: that forces with this FreeBodies::edge_reach do not show
// it. left_N: what contact of elastic bodies leaves of the loads, per motion; where it is less than
// of rigid bodies, prescribed displacements clamp them. Empty: not known.
std::string why_not_held(const RigidContact& contact, double edge_reach,
                         const Eigen::VectorXd& left_N);

}  // namespace airybench
