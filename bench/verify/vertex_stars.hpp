// Block Gauss–Seidel over vertex stars on ‖σ − Aε(w)‖²: one vertex after another, the coefficients
// of the vertex and its edges together.
//
// For ν near ½ a single coefficient can hardly move without changing the volume of its triangles,
// which costs up to 1/(1 − 2ν) times its share. A star's displacements include some that keep the
// volumes, as in the smoothers of Arnold, Falk & Winther (2000) for div. On Mesh0 with ν = 0.4999
// the distance falls from 14 times the minimum to 2.2 times in one sweep, 1.6 in two.
#pragma once

#include <vector>

#include "assembly/displacement_field.hpp"
#include "solvers/base/element_matrices.hpp"

namespace airybench {

class VertexStars {
 public:
  using OfTriangle = Eigen::Matrix<double, 2, 6>;  // in the order of triangle_nodes()

  // own: per triangle, the displacement with stress Πσ, the linear field nearest to σ. held: fixed.
  VertexStars(const Problem& problem, const std::vector<OfTriangle>& own,
              const std::vector<bool>& held);
  void sweep(DisplacementField& w);

  // True if a bulk modulus exceeds five shear moduli (ν > 0.4 in plane strain). Below, averages
  // alone come within 1.2 times the minimum.
  static bool are_needed(const Problem& problem);

 private:
  void improve(int vertex, DisplacementField& w);

  const Problem& problem_;
  const std::vector<OfTriangle>& own_;
  ElementMatrices K_;                  // unknowns: 2 node + component; −1: held
  std::vector<int> first_, triangle_;  // triangles of vertex v from triangle_[first_[v]]
  std::vector<int> free_, number_;     // nodes of a star; node → place there, or −1
  std::vector<double> matrix_;
};

}  // namespace airybench
