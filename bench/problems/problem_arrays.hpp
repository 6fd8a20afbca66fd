// A posed problem as named arrays, whatever file format they go to.
//
// The Airy system (dual_system.hpp) and the condensed contact problem (condensed.hpp) of one mesh
// under one scene, with the tables that say what every unknown, row and contact point is. Indices
// count from 0.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "solvers/contact/condensed.hpp"

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

struct CondensedProblem {
  ContactPoints contact;
  CondensedSystem condensed;
  Eigen::VectorXd answer = {};       // F_C to compare with; empty: none is given away
  Eigen::VectorXd gap() const;       // zeros where ContactPoints has none
  Eigen::VectorXd friction() const;  // per contact point
};

// vertices_mm, triangles, edges, boundary, boundary_roles.
std::vector<ProblemArray> mesh_arrays(const Mesh& mesh);
// With these everything that a displacement method needs: triangle_body, compliance_per_MPa,
// rollers, u0_mm, traction_MPa, gap_mm, contact_normals, contact_moment_normals, friction,
// body_force_N_per_mm3.
std::vector<ProblemArray> body_arrays(const Problem& problem);
// S, C_F, q, F, scale, unknowns; force_rows, force_directions of C_F's rows; with contact C_C, F0.
std::vector<ProblemArray> airy_arrays(const DualSystem& system);
// D, G, gap, mu, F_C if it is given away; of a body contact_points_mm, and contact_rows,
// contact_directions of the rows of F_C.
std::vector<ProblemArray> condensed_arrays(const Problem& problem,
                                           const CondensedProblem& condensed);

}  // namespace airybench
