// The numbering of edge displacements in the hybridized system (hybridized.hpp).
#pragma once

#include <array>
#include <vector>

#include "assembly/dual_system.hpp"

namespace airybench {

constexpr int prescribed_unknown = -1;

// Per edge: the numbers of its four unknowns, x and y at its low vertex, x and y at its high one;
// on Γ_C and rollers normal and tangential at its start and end. Inner unknowns first, then the
// contact rows in the order of ContactPoints (without friction the tangential ones are inner
// unknowns).
using EdgeUnknowns = std::vector<std::array<int, 4>>;

// Numbers the unknowns of every edge; returns how many are inner ones.
int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown);

// The numbers of a triangle's twelve edge unknowns.
std::array<int, 12> element_unknowns(const Problem& problem, const EdgeUnknowns& unknown,
                                     int triangle);

// Per edge whose unknowns are normal and tangential its row of Mesh::boundary, else no_frame.
constexpr int no_frame = -1;
std::vector<int> rows_in_frame(const Problem& problem);

// ū of every edge, in x and y, from the unknowns and prescribed_displacements(); rows: at its low
// vertex, at its high one. mm
Eigen::Matrix4Xd edge_moments(const Problem& problem, const EdgeUnknowns& unknown,
                              const std::vector<Eigen::Vector4d>& prescribed,
                              const Eigen::VectorXd& u);

// ū0 per edge, in its components, zero where nothing is prescribed; empty: all zero.
std::vector<Eigen::Vector4d> prescribed_displacements(const Problem& problem);

}  // namespace airybench
