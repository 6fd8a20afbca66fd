// A rough diagonal of D: in the plane a force spread over an edge moves it by a multiple of the
// material's compliance, whatever the edge's size: 3 to 7 times along the normal, 11 to 20 times
// along the tangent on Mesh0..Mesh4.
#pragma once

#include "assembly/contact_system.hpp"

namespace airybench {

// Per row of F_C, mm/N: 5 and 15 times C_xxxx of the triangle at the point's edge.
Eigen::VectorXd rough_compliance(const Problem& problem, const ContactPoints& contact);
// For parts of a body: C_xxxx per row of the boundary, then the compliance from it.
Eigen::VectorXd compliance_at_boundary(const Problem& problem);
Eigen::VectorXd rough_compliance(const Eigen::VectorXd& at_boundary, const ContactPoints& contact);

}  // namespace airybench
