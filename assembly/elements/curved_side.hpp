// A curved side of a triangle, x(ξ), 0 ≤ ξ ≤ 1, walked counter-clockwise, whose ends are corners a
// and b of the triangle. N = (y′, −x′) is its outward normal times the length per unit of ξ.
//
// Forces of a density q dξ on it (the traction σN; a load f |x′|), and the moments of displacements
// that they work on, belong to complex polynomials on the chord, continued to the curve:
//
//   F_j = (G⁻¹ m)_j,   m_j = ∫ conj(B_j(ẑ)) q dξ,   G_ij = (k + 1) ∫ B_i B_j dξ,
//   ẑ = (z(ξ) − z_a)/(z_b − z_a)
//
// with x and y as real and imaginary parts. On a straight side they are those of
// equilibrium_element.hpp. On any curve they have all rigid motions, whose moments are those on the
// chord; walked the other way j becomes k − j.
//
// The third of the triangle on this side, up to the centroid V4 of the corners, has the points
// V4 + ρ (x(ξ) − V4), 0 ≤ ρ ≤ 1. Stresses on it are the polynomials of the straight third.
//
// Integrals are Gauss sums, exact to 1e-15 for sides that turn by 45°. Scalar: double, Wide.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "assembly/elements/small_cholesky.hpp"
#include "support/wide.hpp"

namespace airybench {

// Per side of a triangle points of its curve, mm; none: it is straight.
using CurvedSides = std::array<std::span<const Eigen::Vector2d>, 3>;

template <typename Scalar>
class CurvedSide {
 public:
  using Vector = Eigen::Vector2<Scalar>;
  using Matrix = Eigen::MatrixX<Scalar>;
  static constexpr int points = 15, layers = 7;  // along ξ and ρ

  // points_mm: x at equidistant ξ from 0 to 1, which are as many as a polynomial needs; degree: k.
  CurvedSide(std::span<const Eigen::Vector2d> points_mm, int degree);

  const Vector& at(int q) const { return at_[q]; }
  const Vector& normal(int q) const { return normal_[q]; }  // N
  static const Scalar& weight(int q);

  // F of a density at the points, columns, times dξ: k + 1 columns.
  Eigen::Matrix2X<Scalar> forces(const Eigen::Matrix2X<Scalar>& density) const;
  // F of the stresses B_i xx, B_i yy, B_i xy of the third: rows as F by columns, columns 3 i + 0,
  // 1, 2.
  Matrix stress_forces(const Vector& centroid) const;
  // W with |W c|² = ∫ p² over the third, mm², p = Σ c_i B_i; upper triangular.
  Matrix mass_root(const Vector& centroid) const;
  // All B_i of the third, at V4 + ρ (x(ξ_q) − V4).
  Eigen::VectorX<Scalar> bernstein(const Vector& centroid, int q, const Scalar& rho) const;

 private:
  int degree_;
  Vector a_, b_;
  std::array<Vector, points> at_, normal_;
  std::array<Matrix, points> complex_;  // 2 × (k + 1): B_j(ẑ)
  GramRoot<Scalar> gram_;               // of G
};

extern template class CurvedSide<double>;
extern template class CurvedSide<Wide>;

}  // namespace airybench
