// Block Gauss–Seidel over vertex stars on ‖σ − Aε(w)‖²: one vertex after another, by their places
// and not their numbers, the coefficients of the vertex and its edges together. Those inside
// triangles are eliminated.
//
// For ν near ½ a single coefficient can hardly move without changing the volume of its triangles,
// which costs up to 1/(1 − 2ν) times its share. A star's displacements include some that keep the
// volumes, as in the smoothers of Arnold, Falk & Winther (2000) for div. On Mesh0 with ν = 0.4999
// the distance falls from 14 times the minimum to 2.2 times in one sweep, 1.6 in two.
#pragma once

#include <vector>

#include "assembly/curved_traces.hpp"
#include "assembly/displacement_field.hpp"

namespace airybench {

// True if a bulk modulus exceeds five shear moduli (ν > 0.4 in plane strain). Below, averages
// alone come within 1.2 times the minimum.
bool need_vertex_stars(const Problem& problem);

class VertexStars {
 public:
  // own: one triangle after another, the coefficients of the displacement with the stress nearest
  // to σ, as its traces. held: fixed.
  VertexStars(const Problem& problem, const DisplacementTriangle& triangle,
              const CurvedTraces& traces, const Eigen::Matrix2Xd& own,
              const std::vector<bool>& held);
  // Leaves inner coefficients as they are.
  void sweep(DisplacementField& w);

 private:
  void improve(int vertex, DisplacementField& w);

  const Problem& problem_;
  const DisplacementTriangle& element_;
  const Eigen::Matrix2Xd& own_;
  const std::vector<bool>& held_;
  std::vector<Eigen::MatrixXd> K_;     // per triangle, of the outer nodes, without the inner ones
  std::vector<int> order_;             // vertices by x, then y
  std::vector<int> first_, triangle_;  // triangles of vertex v from triangle_[first_[v]]
  std::vector<int> free_, number_;     // nodes of a star; node → place there, or −1
  std::vector<double> matrix_;
};

}  // namespace airybench
