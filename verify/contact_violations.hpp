// What an engineer asks of an answer: does the body go through the wall, does the wall pull, does
// friction hold more than it can?
#pragma once

#include "assembly/contact_problem.hpp"
#include "assembly/displacement_field.hpp"

namespace airybench {

// |F_t| of a point.
double tangential_force(const ContactPoints& contact, const Eigen::VectorXd& F, int point);

// The largest difference of a force and its reaction on another body, N, beyond the rounding of
// both points' forces, N (empty: none).
double not_transmitted(const ContactPoints& contact, const Eigen::VectorXd& F,
                       const Eigen::VectorXd& rounding = {});

// Largest F_n > 0 and |F_t| − μ max(0, −F_n) of a contact point, over the largest component of F.
struct ForceViolations {
  double tension = 0, friction_excess = 0;
};
ForceViolations force_violations(const ContactPoints& contact, const Eigen::VectorXd& F);

// Largest u_n − g0 > 0 on Γ_C, along each edge's normals; between bodies u_n and g0 are those of
// both. A vertex where two walls meet may be behind one of them, since its law has one normal
// (control_points.hpp): the smaller u_n − g0 counts, also as the coefficient of both edges.
struct Penetration {
  double at_nodes_mm = 0;  // at vertices and at p − 1 points of an edge, evenly spaced
  double on_edges_mm = 0;  // anywhere: also an error of the discretisation
  double share = 0;        // at nodes, of the largest |w|; of the largest |u| if w = 0
};
Penetration penetration(const Problem& problem, const DisplacementField& w);

}  // namespace airybench
