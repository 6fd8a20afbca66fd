// A posed problem as named arrays, independent of the file format: the Airy system
// (airy_system.hpp) and the contact problem (contact_problem.hpp) of a mesh and a scene, with
// tables that describe every unknown, row and contact point. Indices count from 0.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "assembly/airy_system.hpp"

namespace airybench {

struct ProblemArray {
  // A vector is a one-column matrix. Symmetric sparse matrices are stored whole.
  using Values = std::variant<Eigen::MatrixXd, Eigen::MatrixXi, SparseRows>;
  std::string name;   // "C_F"; the stem of its file
  std::string unit;   // "N"; "1": no unit
  std::string about;  // one line, ASCII
  Values values;
  bool symmetric = false;

  Eigen::Index rows() const;
  Eigen::Index columns() const;
  bool is_vector() const { return columns() == 1; }
};

// vertices_mm, triangles, edges, boundary, boundary_roles.
std::vector<ProblemArray> mesh_arrays(const Mesh& mesh);
// With mesh_arrays() all that a displacement method needs: triangle_body, compliance_per_MPa,
// rollers, u0_mm, traction_MPa, gap_mm, contact_normals, contact_moment_normals, friction,
// body_force_N_per_mm3.
std::vector<ProblemArray> body_arrays(const Problem& problem);
// S, C_F, q, F, scale, unknowns; with contact C_C, F0; force_rows, force_directions per row of C_F.
std::vector<ProblemArray> airy_arrays(const AirySystem& system);
// K, b, unknowns of the hybridized system (hybridized.hpp), stresses of that degree; with contact
// first_contact_unknown.
std::vector<ProblemArray> hybrid_arrays(const Problem& problem, int degree);
// gap and mu; zeros if there are none.
std::vector<ProblemArray> contact_law_arrays(const ContactPoints& points);
// D, G, gap, mu; F_C, an answer to compare with, unless `answer` is empty.
std::vector<ProblemArray> contact_arrays(const contact::Problem& problem,
                                         const Eigen::VectorXd& answer);
// contact_points_mm; contact_rows and contact_directions per row of F_C.
std::vector<ProblemArray> contact_place_arrays(const Problem& body, const ContactPoints& points);

// One column; an empty vector gives `size` zeros.
Eigen::MatrixXd written_out(const Eigen::VectorXd& vector, Eigen::Index size);

// The force of a row of C_F (Known::force) or C_C (Known::contact_law), in row order.
struct KnownRow {
  int boundary_row;  // of Mesh::boundary
  int end;           // 0: start of its walk, 1: end
  Eigen::Vector2d direction;
};
std::vector<KnownRow> known_rows(const Problem& problem, Known known);

}  // namespace airybench
