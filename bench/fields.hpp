// Stresses and contact points of a solution, as CSV for figures and other programs.
//
//   NAME.stress.csv   triangle, third, corner, x_mm, y_mm, sxx_MPa, syy_MPa, sxy_MPa
//                     nine rows per triangle: the corners of its thirds, as in HctStress
//   NAME.contact.csv  x_mm, y_mm, normal_x, normal_y, edge_length_mm, F_n_N, F_t_N, state
//                     a row per contact point; state open, stick or slip
//   NAME.boundary.csv x0_mm, y0_mm, x1_mm, y1_mm, role
#pragma once

#include <filesystem>

#include "assembly/dual_system.hpp"
#include "solvers/solution.hpp"

namespace airybench {

// Writes the three files folder/NAME.*.csv; throws std::runtime_error.
void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const DualSystem& system, const Solution& solution);

}  // namespace airybench
