// Stresses and contact points of a solution, as CSV for figures and other programs.
//
//   NAME.stress.csv   triangle, third, corner, x_mm, y_mm, sxx_MPa, syy_MPa, sxy_MPa
//                     nine rows per triangle: the corners of its thirds, as in HctStress
//   NAME.contact.csv  x_mm, y_mm, normal_x, normal_y, edge_length_mm, F_n_N, F_t_N, state
//                     a row per contact point; state open, stick or slip
//                     (a displacement method: the tractions of its stresses, the state of its
//                     control points)
//   NAME.boundary.csv x0_mm, y0_mm, x1_mm, y1_mm, role
//   NAME.error.csv    triangle, error_share
//                     a row per triangle, in the order of NAME.stress.csv: its share, 0 to 1, of
//                     the squared constitutive relation error, contact terms included
//   NAME.mean.csv     as NAME.stress.csv: the mean of the stresses and those of the displacements
#pragma once

#include <filesystem>

#include "assembly/dual_system.hpp"
#include "bench/judging/discretisation_error.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

// Writes the first three files folder/NAME.*.csv; throws FileError.
void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const DualSystem& system, const Solution& solution);
// Each writes the file folder/NAME.*.csv of its kind; throws FileError.
void write_mean_field(const std::filesystem::path& folder, const std::string& name,
                      const Problem& problem, const StressField& mean);
void write_error_field(const std::filesystem::path& folder, const std::string& name,
                       const ConstitutiveError& error);

}  // namespace airybench
