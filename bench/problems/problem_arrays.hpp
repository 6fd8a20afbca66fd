// A posed problem as named arrays, whatever file format they go to.
//
// The Airy system (dual_system.hpp) and the condensed contact problem (condensed.hpp) of one mesh
// under one scene, with the tables that say what every unknown, row and contact point is. Indices
// count from 0.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "bench/cases/plan.hpp"
#include "bench/judging/reference.hpp"

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

// The condensed problem in the numbers of the reference, and the answer to compare with.
struct CondensedProblem {
  ContactPoints contact;
  Reference reference;
  Eigen::VectorXd gap() const;       // zeros where ContactPoints has none
  Eigen::VectorXd friction() const;  // per contact point
};
// Throws InputError: no contact points, or a reference that cannot be had.
CondensedProblem condensed_problem(const PosedScene& posed);

// vertices_mm, triangles, edges, boundary, boundary_roles.
std::vector<ProblemArray> mesh_arrays(const Mesh& mesh);
// S, C_F, q, F, scale, unknowns; force_rows, force_directions of C_F's rows; with contact C_C, F0.
std::vector<ProblemArray> airy_arrays(const DualSystem& system);
// D, G, gap, mu, F_C, contact_points_mm, and contact_rows, contact_directions of the rows of F_C.
std::vector<ProblemArray> condensed_arrays(const Problem& problem,
                                           const CondensedProblem& condensed);

}  // namespace airybench
