// A curved side of a triangle, x(ξ), 0 ≤ ξ ≤ 1, walked counter-clockwise, whose ends are corners a
// and b of the triangle. N = (y′, −x′) is its outward normal times the length per unit of ξ.
//
// Forces of a density q dξ on it (the traction σN; a load f |x′|), and the moments of displacements
// that they work on, are tested with complex polynomials on the chord, continued to the curve; x
// and y are real and imaginary parts:
//
//   m_i = ∫ conj(T_i) q dξ,   T_i = B_i(ẑ),   ẑ = (z(ξ) − z_a)/(z_b − z_a),
//   F = P⁻¹ m,   ū = Pᵀ c,   P_ij = (k + 1) ∫ B_i B_j dξ
//
// where Σ T_i c_i is the best approximation of u. On a straight side these are F and ū of
// equilibrium_element.hpp. On any curve they have all rigid motions, whose moments are those on the
// chord; walked the other way j becomes k − j.
//
// Under a contact law a density is a polynomial in its frames along the curve, R(ξ) = (n, t),
//
//   q = Σ_j Q_j F_j,   Q_j = (k + 1) B_j(ξ) R(ξ) R_jᵀ,   P_ij = ∫ conj(T_i) Q_j dξ
//
// with fixed frames R_j, in which F_j are pressure and friction, ū_j normal and tangential motion.
// The test functions stay, and with them the rigid motions. Normals between those given are their
// interpolant's.
//
// The third of the triangle on this side, up to the centroid V4 of the corners, has the points
// V4 + ρ (x(ξ) − V4), 0 ≤ ρ ≤ 1. Stresses on it are the polynomials of the straight third.
//
// Integrals are Gauss sums, exact to 1e-15 for sides that turn by 45°. Scalar: double, Wide.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <span>

#include "assembly/elements/small_cholesky.hpp"
#include "assembly/elements/stress_degrees.hpp"
#include "support/wide.hpp"

namespace airybench {

struct SideCurve {
  static constexpr int max_parts = 7;  // points_mm and law_normals have at most one more
  // At equidistant ξ from 0 to 1, as many as a polynomial needs; none: a straight side.
  std::span<const Eigen::Vector2d> points_mm;
  // n of a contact law at equidistant ξ from 0 to 1, and of the k + 1 frames R_j; none: there is
  // no such law.
  std::span<const Eigen::Vector2d> law_normals, moment_normals;

  bool is_straight() const { return points_mm.empty(); }
};
using CurvedSides = std::array<SideCurve, 3>;  // of a triangle

// x(ξ), x′(ξ), and R(ξ); without a contact law R is the identity.
template <typename Scalar>
struct CurvePoint {
  CurvePoint(const SideCurve& curve, const Scalar& xi);
  // basis_of(parts): the LagrangeBasis at ξ.
  template <typename Basis>
  CurvePoint(const SideCurve& curve, const Basis& basis_of);
  Eigen::Vector2<Scalar> at, tangent;
  Eigen::Matrix2<Scalar> frame;
};

// The third of a triangle between a curve and V4.
template <typename Scalar>
class CurvedThird {
 public:
  using Vector = Eigen::Vector2<Scalar>;
  using Matrix = Eigen::MatrixX<Scalar>;
  static constexpr int points = 15, max_layers = 7;  // along ξ and ρ

  // degree: k.
  CurvedThird(const SideCurve& curve, int degree);

  const Vector& at(int q) const { return at_[q]; }
  const Vector& normal(int q) const { return normal_[q]; }  // N
  static const Scalar& xi(int q);
  static const Scalar& weight(int q);

  // Points across the third, by a rule of so many: ρ, and the area that a point stands for, mm². A
  // product of two polynomials of degree k needs k + 1.
  struct Layer {
    Scalar rho, area;
  };
  Layer layer(const Vector& centroid, int q, int l, int layers = max_layers) const;
  // All B_i of the third, at V4 + ρ (x(ξ_q) − V4).
  Eigen::VectorX<Scalar> bernstein(const Vector& centroid, int q, const Scalar& rho) const;
  // W with |W c|² = ∫ p² over the third, mm², p = Σ c_i B_i; upper triangular.
  Matrix mass_root(const Vector& centroid) const;

 protected:
  int degree_;
  Vector a_, b_;
  std::array<Vector, points> at_, normal_;
};

template <typename Scalar>
class CurvedSide : public CurvedThird<Scalar> {
 public:
  using typename CurvedThird<Scalar>::Vector, typename CurvedThird<Scalar>::Matrix;
  using CurvedThird<Scalar>::points, CurvedThird<Scalar>::xi, CurvedThird<Scalar>::weight,
      CurvedThird<Scalar>::at, CurvedThird<Scalar>::normal;

  CurvedSide(const SideCurve& curve, int degree);

  // F of a density at the points, columns, times dξ: k + 1 columns.
  Eigen::Matrix2X<Scalar> forces(const Eigen::Matrix2X<Scalar>& density) const;
  // ū of displacements at the points.
  Eigen::Matrix2X<Scalar> moments(const Eigen::Matrix2X<Scalar>& displacement) const;
  // ū of u(x).
  template <typename Displacement>
  Eigen::Matrix2X<Scalar> moments_of(const Displacement& u) const {
    Eigen::Matrix2X<Scalar> displacement(2, points);
    for (int q = 0; q < points; ++q) displacement.col(q) = u(at_[q]);
    return moments(displacement);
  }
  // Under a contact law q of F at a point: the traction times |x′|.
  Vector density(const Eigen::Matrix2X<Scalar>& forces, int q) const;
  // F of the stresses B_i xx, B_i yy, B_i xy of the third: rows as F by columns, columns 3 i + 0,
  // 1, 2.
  Matrix stress_forces(const Vector& centroid) const;

 private:
  using OfPoint = Eigen::Matrix<Scalar, 2, Eigen::Dynamic, Eigen::ColMajor, 2,
                                2 * (highest_stress_degree + 2)>;  // k + 1: of displacements

  void set_test(int q);
  Eigen::VectorX<Scalar> tested(const Eigen::Matrix2X<Scalar>& field) const;  // m

  using CurvedThird<Scalar>::degree_, CurvedThird<Scalar>::a_, CurvedThird<Scalar>::b_,
      CurvedThird<Scalar>::at_, CurvedThird<Scalar>::normal_;
  std::array<OfPoint, points> test_;     // 2(k + 1) columns T_i: m_i = ∫ T_i·q dξ
  std::array<OfPoint, points> density_;  // q = density F
  Eigen::PartialPivLU<Matrix> pairing_;  // P
  Matrix pairing_transposed_;
};

extern template struct CurvePoint<double>;
extern template struct CurvePoint<Wide>;
extern template class CurvedThird<double>;
extern template class CurvedThird<Wide>;
extern template class CurvedSide<double>;
extern template class CurvedSide<Wide>;

}  // namespace airybench
