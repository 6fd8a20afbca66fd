// The numbering of edge displacements in the hybridized system (hybridized.hpp).
#pragma once

#include <vector>

#include "assembly/contact_system.hpp"
#include "solvers/base/equal_rows.hpp"

namespace airybench {

constexpr int prescribed_unknown = -1;

// Per edge: the numbers of its 2(k + 1) unknowns, x and y of each moment from its low vertex on; on
// Γ_C and rollers normal and tangential, from its start on. Inner unknowns first, then the contact
// rows in the order of ContactPoints (without friction the tangential ones are inner unknowns).
using EdgeUnknowns = EqualRows<int>;

// Numbers the unknowns of every edge; returns how many are inner ones.
int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown);

// The numbers of the unknowns of a triangle's edges, one edge after another.
void element_unknowns(const Problem& problem, const EdgeUnknowns& unknown, int triangle,
                      std::vector<int>& numbers);

// Per edge whose unknowns are normal and tangential its row of Mesh::boundary, else no_frame.
constexpr int no_frame = -1;
std::vector<int> rows_in_frame(const Problem& problem);

// ū of every edge (EdgeDisplacements), from the unknowns and prescribed_displacements(). mm
Eigen::MatrixXd edge_moments(const Problem& problem, const EdgeUnknowns& unknown,
                             const Eigen::MatrixXd& prescribed, const Eigen::VectorXd& u);

// ū0, a column per edge, in its components, zero where nothing is prescribed; empty: all zero.
Eigen::MatrixXd prescribed_displacements(const Problem& problem, int degree);

// Of u_th (thermal_strain.hpp) on the edges of each triangle, a column per triangle, as
// element_unknowns() lists them; empty: all zero.
Eigen::MatrixXd thermal_moments(const Problem& problem, int degree);

}  // namespace airybench
