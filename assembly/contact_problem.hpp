// The contact law at points, and the problem of this law alone: no mesh, no body.
//
//   r = D F − G − ḡ;   F_n ≤ 0, r_n ≤ 0, F_n r_n = 0;
//                      |F_t| ≤ −μ F_n, F_t ∥ r_t, F_t · r_t ≤ 0, r_t ≠ 0 only if |F_t| = −μ F_n
//
// F are forces on the body, N; r its displacements less the gap, mm; n points outward. Rows: per
// point normal, then tangential: none, one, or, in files of problems in space, two.
//
// Where two bodies press on each other both have a point, in opposite frames. F is then the same at
// both, and r the sum of both (paired_points.hpp).
//
// Bodies that contact alone holds move by unknown amounts a of their rigid motions N, and are in
// equilibrium with the loads l on these:
//
//   r = D F − G − ḡ + N a,   Nᵀ F + l = 0
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace airybench {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct RigidContact;

struct FreeBodies {
  Eigen::MatrixXd motions;  // N, n_c × count, in the rows of F_C; no columns: none
  std::shared_ptr<const RigidContact> rigid;  // has l
  // How near to its ends the resultant of an edge's forces F may be, over its length.
  double edge_reach = 0;
  bool is_empty() const { return motions.cols() == 0; }
};

struct ContactPoints {
  int count = 0;  // for a body `per_edge` on each contact edge, from its start on
  int per_edge = 2;
  int components = 2;            // per point: 1 (normal, μ = 0), 2 (plane) or 3 (space)
  std::vector<double> friction;  // μ per point; empty with one component
  Eigen::VectorXd gap;           // ḡ, mm, in the order of F_C: per point normal and, where the
                                 // body is moved along the wall, tangential; empty: zero
  std::vector<int> boundary;     // per point: row of Mesh::boundary; empty: no body
  // Per point: the other body's point that it presses on; no_point: a wall. Empty: walls only.
  static constexpr int no_point = -1;
  std::vector<int> opposite;
  FreeBodies free;
  int opposite_of(int point) const {
    return opposite.empty() ? no_point : opposite[static_cast<std::size_t>(point)];
  }
  // Per row of Mesh::boundary, of so many: its first point; no_point: it has none.
  std::vector<int> first_points(std::size_t rows) const {
    std::vector<int> first(rows, no_point);
    for (int p = 0; p < count; p += per_edge)
      first[static_cast<std::size_t>(boundary[static_cast<std::size_t>(p)])] = p;
    return first;
  }
  double friction_at(int point) const {
    return friction.empty() ? 0 : friction[static_cast<std::size_t>(point)];
  }
  int size() const { return count * components; }  // n_c
};

namespace contact {

// D = Hᵀ M⁻¹ H of bodies with many contacts, which is not formed: v = M⁻¹ H F are their motions.
struct Bodies {
  Eigen::SparseMatrix<double> M, H;  // n × n, symmetric positive definite, whole; n × n_c
  Eigen::VectorXd D_diagonal;        // rough: of Hᵀ diag(M)⁻¹ H, exact where M is diagonal
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> solve;  // M⁻¹ b
};

// A condensed body, the paper's eq. (5), ū_C = D F_C − G, or a file's problem in the file's units.
// D is in one of three forms; the others are empty.
struct Problem {
  // n_c × n_c, mm/N, compliance: symmetric positive definite for a body; from a file perhaps
  // semidefinite, and nearly symmetric.
  Eigen::MatrixXd D = {};
  Eigen::VectorXd G = {};  // n_c, mm; −G: displacements without contact forces
  ContactPoints points = {};
  std::string name = {};     // for a file its stem
  bool is_symmetric = true;  // D, exactly; of bodies it always is
  SparseRows rows = {};      // D with few entries; with all m × m of every point
  std::shared_ptr<const Bodies> bodies = {};
  std::string how = {};  // of a file: how D came about and is held, for records

  bool is_dense() const { return rows.size() == 0 && bodies == nullptr; }
  std::size_t bytes() const {  // of D and G
    const auto numbers = static_cast<std::size_t>(D.size() + G.size() + rows.nonZeros());
    const auto indices = static_cast<std::size_t>(rows.nonZeros() + rows.outerSize());
    return numbers * sizeof(double) + indices * sizeof(int);
  }
};

}  // namespace contact
}  // namespace airybench
