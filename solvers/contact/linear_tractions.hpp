// The contact law in linear tractions, for edges with more than two control points.
//
// A traction of degree k has on every edge the control forces F = R F₁, where F₁ are those of a
// linear one (bernstein.hpp: the coefficient i of k is (1 − i/k) t₀ + (i/k) t₁, a force 1/(k + 1)
// of it):
//
//   R_i0 = 2/(k + 1) (1 − i/k),   R_i1 = 2/(k + 1) (i/k)
//   D₁ = Rᵀ D R,   G₁ = Rᵀ G,   ḡ₁ = Rᵀ ḡ
//
// Its answer is in the cone, too, and costs ((k + 1)/2)³ times less a step: Newton's method starts
// from it.
#pragma once

#include "assembly/contact_problem.hpp"

namespace airybench {

// Points of a body, more than two an edge, that press on walls, and a dense D.
bool has_linear_tractions(const contact::Problem& problem);
contact::Problem in_linear_tractions(const contact::Problem& problem);
Eigen::VectorXd of_linear_tractions(const ContactPoints& points,
                                    const Eigen::VectorXd& F1);  // R F₁

}  // namespace airybench
