// A posed problem as named arrays, whatever file format they go to.
//
// The Airy system (dual_system.hpp) and the contact problem (contact_problem.hpp) of one mesh under
// one scene, with the tables that say what every unknown, row and contact point is. Indices count
// from 0.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "assembly/dual_system.hpp"

namespace airybench {

struct ProblemArray {
  // A vector is a matrix of one column; a symmetric sparse matrix is stored whole.
  using Values = std::variant<Eigen::MatrixXd, Eigen::MatrixXi, SparseRows>;
  std::string name;   // "C_F"; the stem of its file
  std::string unit;   // "N"; "1": it has none
  std::string about;  // one line, ASCII
  Values values;
  bool symmetric = false;

  Eigen::Index rows() const;
  Eigen::Index columns() const;
  bool is_vector() const { return columns() == 1; }
};

// vertices_mm, triangles, edges, boundary, boundary_roles.
std::vector<ProblemArray> mesh_arrays(const Mesh& mesh);
// With these everything that a displacement method needs: triangle_body, compliance_per_MPa,
// rollers, u0_mm, traction_MPa, gap_mm, contact_normals, contact_moment_normals, friction,
// body_force_N_per_mm3.
std::vector<ProblemArray> body_arrays(const Problem& problem);
// S, C_F, q, F, scale, unknowns; force_rows, force_directions of C_F's rows; with contact C_C, F0.
std::vector<ProblemArray> airy_arrays(const DualSystem& system);
// gap and mu, zeros where there are none.
std::vector<ProblemArray> contact_law_arrays(const ContactPoints& points);
// D, G, gap, mu; F_C, an answer to compare with, unless it is empty.
std::vector<ProblemArray> contact_arrays(const contact::Problem& problem,
                                         const Eigen::VectorXd& answer);
// contact_points_mm; contact_rows and contact_directions of the rows of F_C.
std::vector<ProblemArray> contact_place_arrays(const Problem& body, const ContactPoints& points);

// A vector of a system, where empty is zero, as a column.
Eigen::MatrixXd written_out(const Eigen::VectorXd& vector, Eigen::Index size);

// Which force a row of C_F (Known::force) or C_C (Known::contact_law) is, in their order.
struct KnownRow {
  int boundary_row;  // of Mesh::boundary
  int end;           // 0: start of its walk, 1: end
  Eigen::Vector2d direction;
};
std::vector<KnownRow> known_rows(const Problem& problem, Known known);

}  // namespace airybench
