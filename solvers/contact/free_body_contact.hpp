// The contact law of bodies that contact alone holds (contact_problem.hpp):
//
//   r = D F − G − ḡ + N a,   Nᵀ F + l = 0
//
// D is that of pinned bodies. A spring of compliance m holds every motion at a_k, and yields to
// what is not balanced, a = a_k + m (Nᵀ F + l):
//
//   r = (D + m N Nᵀ) F − (G − N (a_k + m l)) − ḡ
//
// is an ordinary contact problem; then a_{k+1} = a, and m is 10 times larger. (Proximal steps of
// the method of multipliers, Rockafellar 1976, doi:10.1287/moor.1.2.97.) What stays unbalanced
// falls by 1 + m c per step, c the contact's stiffness against the motion: where there is none, and
// a load, it stays. As m N Nᵀ costs digits of D, firmer springs follow. Without springs F solves
// the problem, too, with a_{k+1}: r is the same.
//
// Motions that no contact resists (motion_spaces) are left out; their amounts are zero.
#pragma once

#include "solvers/contact/condensed.hpp"

namespace airybench {

// D must be dense. Throws Breakdown where loads stay unbalanced or ask for a motion that no contact
// resists, with what rigid bodies do then (released_bodies.hpp).
ContactResult solve_with_free_bodies(const contact::Problem& problem, const ContactOptions& options,
                                     const Deadline& deadline);

// Throws Breakdown where loads ask for a motion that no contact resists, with the forces in point
// supports, and where these hold a motion that contact resists.
void refuse_loads_on_open_motions(const RigidContact& rigid);

// The largest load on a motion that contact leaves, over the largest sum of forces on one; 0
// without free bodies, and where it is RigidContact::rounding_N at most.
double unbalanced_share(const FreeBodies& free, const Eigen::VectorXd& F);

// For methods without D. Throws Breakdown.
void refuse_free_bodies(const ContactPoints& contact);

// Motions that are known stand in the gap.
ContactPoints with_known_motion(ContactPoints points, const Eigen::VectorXd& motion_mm);

}  // namespace airybench
