// The contact law at points, and the problem that is nothing but this law: no mesh, no body.
//
//   r = D F − G − ḡ;   F_n ≤ 0, r_n ≤ 0, F_n r_n = 0;
//                      |F_t| ≤ −μ F_n, F_t r_t ≤ 0, r_t ≠ 0 only if |F_t| = −μ F_n
//
// F are forces on the body, N, r its displacements less the gap, mm, n outward. Rows: per point
// normal, then tangential.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace airybench {

struct ContactPoints {
  int count = 0;                 // of a body two per contact edge: its start, its end
  int components = 2;            // per point: normal and tangential, or with μ = 0 normal only
  std::vector<double> friction;  // μ per point; empty with one component
  Eigen::VectorXd gap;  // ḡ, mm: the normal and, where the body is moved along the wall, the
                        // tangential one of every point, in the order of F_C; empty: zero
  std::vector<int> boundary;  // per point: row of Mesh::boundary; empty: there is no body
  double friction_at(int point) const {
    return friction.empty() ? 0 : friction[static_cast<std::size_t>(point)];
  }
  int size() const { return count * components; }  // n_c
};

namespace contact {

// What bodies are condensed to, the paper's eq. (5), ū_C = D F_C − G, and what files of other
// programs hold. Units of such files are the files'.
struct Problem {
  Eigen::MatrixXd D = {};  // n_c × n_c, mm/N, symmetric positive definite compliance
  Eigen::VectorXd G = {};  // n_c, mm; −G are the displacements with no contact force
  ContactPoints points = {};
  std::string name = {};  // of a file its stem

  std::size_t bytes() const {  // of D and G
    return static_cast<std::size_t>(D.size() + G.size()) * sizeof(double);
  }
};

}  // namespace contact
}  // namespace airybench
