// Writes the fields of a solution: CSV for figures and other programs, VTU for ParaView.
//
//   NAME.stress.csv   triangle, third, corner, x_mm, y_mm, sxx_MPa, syy_MPa, sxy_MPa; nine rows per
//                     triangle: the corners of its thirds, as in HctStress
//   NAME.displacement.csv  triangle, node, x_mm, y_mm, ux_mm, uy_mm; six rows per triangle: its
//                     corners, then the middles of edges 12, 23, 31; quadratic, continuous
//   NAME.contact.csv  x_mm, y_mm, normal_x, normal_y, edge_length_mm, F_n_N, F_t_N, gap_mm,
//                     slip_mm, opposite (row of the other body's point, from 1), piece (of the
//                     mesh, from 1), state (open, stick, slip); a row per contact point
//                     (ContactPicture)
//   NAME.boundary.csv x0_mm, y0_mm, x1_mm, y1_mm, rolls (0 or 1), the tractions given on Γ_F at
//                     both ends t0_x_MPa, t0_y_MPa, t1_x_MPa, t1_y_MPa, and role
//   NAME.faces.csv    face, along_mm, x_mm, y_mm, pressure_MPa, shear_MPa, gap_mm, slip_mm, state;
//                     contact faces as the body is walked; five rows per edge: polynomials of
//                     degree k along it, of gap and slip those whose moments are in
//                     NAME.contact.csv, which a linear one would give to an order only; where
//                     contact ends within the edge they oscillate. The state is that of the nearest
//                     contact point
//   NAME.answer.json  see part_answer.hpp. Of displacement methods neither is there
//   NAME.von_mises.csv, NAME.outline.csv  see part_picture.hpp; of `bench solve`
//   NAME.points.json  at the points asked for: at_mm, stress_MPa (xx, yy, xy), displacement_mm
//   NAME.error.csv    triangle, error_share: 0 to 1, of the squared constitutive relation error,
//                     contact terms included; triangles in the order of NAME.stress.csv
//   NAME.mean.csv     as NAME.stress.csv: mean of the stresses and those of the displacements
//   NAME.vtu          a cell per third, without shared points: a triangle for stresses of degree 1,
//                     else a Lagrange triangle of degree k + 1, curved where they follow a curve:
//                     stress_MPa (xx, yy, xy), stress_zz_MPa, von_mises_MPa, principal_MPa (in the
//                     plane) and displacement_mm at points; body, triangle, error_share (of the
//                     triangle)
//   NAME.contact.vtu  a line per contact edge with two points: the columns of NAME.contact.csv
//                     but the length; state 0 open, 1 stick, 2 slip
// Unknown values are left out, and no file of an earlier answer of that name stays.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "assembly/contact_system.hpp"
#include "assembly/displacement_field.hpp"
#include "solvers/base/solution.hpp"
#include "verify/contact_intervals.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/verifier.hpp"

namespace airybench {

// The contact points in Problem::frame_of_moment(), from start to end of each edge. Gap and slip
// are the contact law's: moments over the edge (edge_forces.hpp), from the load step before.
struct ContactPicture {
  std::vector<Eigen::Vector2d> at_mm;
  std::vector<EdgeFrame> frame;
  std::vector<Eigen::Vector2d> force;  // normal, tangential, N
  std::vector<ContactState> state;
  std::vector<double> gap_mm;   // g0 − u_n
  std::vector<double> slip_mm;  // u_t against the wall; empty if unknown
  std::size_t per_edge = 2;
  std::vector<int> opposite;  // ContactPoints::opposite
  std::vector<int> piece;     // of the mesh (MeshPieces) that the point is on, from 0
};

// For a displacement method: the tractions of its stresses, the states of its control points. w:
// the displacement without the problem's rigid motion, if known.
ContactPicture contact_picture(const ContactSystem& system, const Solution& solution,
                               const std::optional<DisplacementField>& w);

struct SolvedFields {
  const ContactSystem& system;
  const Solution& solution;
  // Bernstein coefficients (displacement_field.hpp) without the problem's rigid motion.
  std::optional<DisplacementField> w;
  const ConstitutiveError* error = nullptr;     // null if unknown
  const ContactIntervals* intervals = nullptr;  // the same
  std::optional<StressField> mean;
  bool picture = false;                         // also the files of part_picture.hpp
  std::vector<Eigen::Vector2d> points_mm = {};  // of NAME.points.json
};

// Without error and mean; w if the solution has its own, and finite.
SolvedFields own_fields(const ContactSystem& system, const Solution& solution);

void remove_files_of_fields(const std::filesystem::path& folder, const std::string& name);

enum class FieldParts { all, contact };  // contact: the files of the contact points

// Writes folder/NAME.* and removes those of an earlier run that are unknown now; throws FileError.
void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const SolvedFields& fields, FieldParts parts = FieldParts::all);

}  // namespace airybench
