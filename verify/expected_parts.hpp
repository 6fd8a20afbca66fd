// Predicts from one solution how the error would spread over a finer mesh, so that a mesh is
// refined several times without a solve for each bisection.
//
// Stresses have degree k on thirds of a triangle T of area A, so its part of e² is e_T² ~
// |∇^(k+1) σ|² A^(k+2). Where the stress is smooth, κ = e_T² / A^(k+2) depends on the solution and
// not on the mesh: a half of T has 2^−(k+2) of its part. Near a vertex v where the stress is
// singular like r^(λ−1), κ ~ r^−s with s = 2k + 4 − 2λ. A part of T with area A' and centroid x is
// expected to have
//
//   κ_T (|x − v| / |x_T − v|)^−s A'^(k+2)     x_T: centroid of T
//
// At v this gives a half of T 2^−λ of its part, as required (the ratio counts as at least √(A'/A),
// for slivers). A vertex is singular if κ falls fast from its triangles to those behind them; λ =
// 0.7 for all (corners have 0.5 … 0.8). At ends of contact inside Γ_C λ = 3/2, but the ends move,
// so they wait for the next mesh.
//
// Chords of length h in place of a curve have η_T² ~ h⁴ (geometry_error.hpp) on the triangles along
// it. Of four parts of T with sides of h/2 two have a sixteenth each: on average its 2^−(5/2) per
// half, so η_T² ~ A^(5/2).
//
// Of all meshes with a given number of triangles the one with equal parts has the least error (e² ~
// Σ κ A^(k+2) for given Σ 1; bulk marking leads there too). So triangles are cut until no expected
// part exceeds a common threshold.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesh/bisection.hpp"

namespace airybench {

class ExpectedParts {
 public:
  // parts: of e², per triangle; negative ones count as zero. degree: k. of_chords: η_T² in them;
  // empty: there is none.
  ExpectedParts(const Mesh& mesh, const MeshEdges& edges, const std::vector<double>& parts,
                int degree = 1, const std::vector<double>& of_chords = {});

  double of(const TrianglePart& part) const;

  // Of a finer mesh: number of triangles, sum and maximum of their parts. Ignores conformity cuts.
  struct Finer {
    double triangles = 0, squared = 0, largest = 0;
  };
  // Cuts the triangle with the largest part until is_enough().
  Finer cut_until(const std::function<bool(const Finer&)>& is_enough) const;

 private:
  struct Triangle {
    double kappa = 0;        // e_T² / A^(k+2)
    double of_chords = 0;    // η_T² / A^(5/2)
    double area_mm2 = 0;     // A
    double exponent = 0;     // s; 0: the stress is smooth
    Eigen::Vector2d vertex;  // v
    double distance_mm = 1;  // |x_T − v|
  };
  double of(const Triangle& triangle, const std::array<Eigen::Vector2d, 3>& corners) const;
  double of_smooth(const Triangle& triangle, double area) const;

  const Mesh& mesh_;
  int power_;  // of A: k + 2
  std::vector<Triangle> triangles_;
};

// The fewest triangles that hold `fraction` of the sum, 0 < fraction ≤ 1, as ascending numbers
// (bulk marking; Dörfler, SIAM J. Numer. Anal. 33, 1996). Ties go to the lower number. Negative
// parts, due to rounding, count as zero.
std::vector<int> bulk_marks(const std::vector<double>& parts, double fraction);

}  // namespace airybench
