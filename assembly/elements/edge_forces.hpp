// Generalised forces on an edge.
//
// Walk an edge a→b of length L counter-clockwise around its triangle: tangent s = (b−a)/L, outward
// normal n = (s_y, −s_x). The traction is t = σn = d/ds (φ,y, −φ,x). ∇φ is quadratic along the
// edge, so t is linear and given by its end values. The generalised forces are F^k = (L/2) t(x_k),
// N, and their work partners ū_k = (2/L) ∫ N_k u ds with the linear N_k:
//   ∫ u·t ds = Σ_k F^k·ū_k
//
// With the end gradients g_a, g_b, the middle one g_m (tangential part from the cubic Hermite of φ,
// normal part the edge's degree of freedom) and R = [0 1; −1 0]:
//   F^a = R (−3 g_a + 4 g_m − g_b) / 2      F^b = R (g_a − 4 g_m + 3 g_b) / 2
//
// Templates are instantiated for double and Wide. Coordinates are exact (exact_data.hpp);
// their differences are taken in Scalar.
#pragma once

#include <Eigen/Core>

#include "assembly/elements/exact_data.hpp"

namespace airybench {

template <typename Scalar>
struct EdgeFrameIn {
  Scalar length_mm;
  Eigen::Vector2<Scalar> tangent, normal;  // unit vectors; normal is outward
};
using EdgeFrame = EdgeFrameIn<double>;

template <typename Scalar = double>
EdgeFrameIn<Scalar> edge_frame(const Eigen::Vector2<Data<Scalar>>& a,
                               const Eigen::Vector2<Data<Scalar>>& b) {
  const Eigen::Vector2<Scalar> edge = b.template cast<Scalar>() - a.template cast<Scalar>();
  const Scalar length = edge.norm();
  const Eigen::Vector2<Scalar> s = edge / length;
  return {length, s, {s.y(), -s.x()}};
}

// Rows: F^a_x, F^a_y, F^b_x, F^b_y. Columns: φ, φ,x, φ,y at a, the same at b, ∂φ/∂n at the middle.
// outward: +1 when the edge's global normal (see hct.hpp) is n, −1 when it is −n.
template <typename Scalar>
using EdgeForcesIn = Eigen::Matrix<Scalar, 4, 7>;
using EdgeForces = EdgeForcesIn<double>;
template <typename Scalar = double>
EdgeForcesIn<Scalar> edge_forces(const Eigen::Vector2<Data<Scalar>>& a,
                                 const Eigen::Vector2<Data<Scalar>>& b, Data<Scalar> outward);

}  // namespace airybench
