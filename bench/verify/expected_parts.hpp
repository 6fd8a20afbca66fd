// How an error would be spread over a finer mesh, told from one solution: so that a mesh can be
// made several times as fine at once, with no solve for each bisection.
//
// Stresses are linear on thirds of a triangle T; of e² it has a part of e_T² ~ |∇²σ|² A³, A its
// area. So κ = e_T² / A³ is a property of the solution and not of the mesh where the stress is
// smooth: a half of T has an eighth of its part. Near a vertex v where the stress is singular like
// r^(λ−1), κ ~ r^−s with s = 6 − 2λ: a part of T, of area A' and with its centroid at x, is
// expected to have
//
//   κ_T (|x − v| / |x_T − v|)^−s A'³     x_T T's centroid
//
// which at v gives a half of T 2^−λ of its part, as it must be (in slivers, too: the first bracket
// counts as √(A'/A) at least). Which vertices are singular is told
// by how κ falls from the triangles at a vertex to those behind them; how strongly cannot be told
// from so few, and λ = 0.7 is taken for all (corners have 0.5 … 0.8; a cut too many at a vertex
// costs a few triangles). Inside Γ_C, where contact ends, λ = 3/2, and the ends move: left to the
// next mesh.
//
// Of all meshes with so many triangles the one whose triangles have equal parts has the least error
// (e² ~ Σ κ A³ for given Σ 1; it is what bulk marking leads to, too): so triangles are to be cut
// until no part is expected to have more than a common threshold.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesh/bisection.hpp"

namespace airybench {

class ExpectedParts {
 public:
  // parts: of e², per triangle; negative ones count as zero.
  ExpectedParts(const Mesh& mesh, const MeshEdges& edges, const std::vector<double>& parts);

  double of(const TrianglePart& part) const;

  // A finer mesh: how many triangles, Σ of their parts, and the largest part. Neighbours that
  // conformity cuts are left out.
  struct Finer {
    double triangles = 0, squared = 0, largest = 0;
  };
  // The triangle with the largest part is cut, and again, until the mesh is fine enough.
  Finer cut_until(const std::function<bool(const Finer&)>& is_enough) const;

 private:
  struct Triangle {
    double kappa = 0;        // e_T² / A³
    double area_mm2 = 0;     // A
    double exponent = 0;     // s; 0: the stress is smooth
    Eigen::Vector2d vertex;  // v
    double distance_mm = 1;  // |x_T − v|
  };
  double of(const Triangle& triangle, const std::array<Eigen::Vector2d, 3>& corners) const;

  const Mesh& mesh_;
  std::vector<Triangle> triangles_;
};

// The fewest triangles that hold `fraction` of the sum, largest parts first (bulk marking; Dörfler,
// SIAM J. Numer. Anal. 33, 1996); of equal parts the lower number. Ascending numbers; negative
// parts, which rounding makes, count as zero. 0 < fraction ≤ 1.
std::vector<int> bulk_marks(const std::vector<double>& parts, double fraction);

}  // namespace airybench
