// What the picture of a part shows, as points along and across it. Unknown displacements are empty.
//
//   NAME.von_mises.csv  third (of a triangle, from 1), x_mm, y_mm, von_mises_MPa: the points of
//                       stress_samples.hpp, as many for each third
//   NAME.outline.csv    edge (of the boundary, from 1), piece (of the mesh, from 1), x_mm, y_mm,
//   ux_mm, uy_mm, tx_MPa, ty_MPa (a
//                       given traction), role, or rollers; as many points for each edge
#pragma once

#include <string>

#include "bench/measure/field_files.hpp"

namespace airybench {

std::string von_mises_csv(const SolvedFields& fields);
// u: with the problem's rigid motion.
std::string outline_csv(const Problem& problem, int degree,
                        const std::optional<DisplacementField>& u);

}  // namespace airybench
