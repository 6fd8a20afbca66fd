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
// Integrals are Gauss sums, exact to 1e-15 for sides that turn by 45°.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "assembly/elements/bernstein.hpp"
#include "support/lagrange.hpp"

namespace airybench {

// n points and weights on [0, 1]: P_n(x) = 0 by Newton's method from the usual guess, and w = 2/((1
// − x²) P_n′(x)²), on [−1, 1].
template <typename Scalar, int n>
struct GaussPoints {
  std::array<Scalar, n> at, weight;

  GaussPoints() {
    constexpr int steps = 8;
    for (int i = 0; i < n; ++i) {
      Scalar x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
      for (int step = 0; step < steps; ++step) {
        Scalar before = 1, value = x;
        for (int m = 2; m <= n; ++m) {
          const Scalar next = ((2 * m - 1) * x * value - (m - 1) * before) / Scalar(m);
          before = value;
          value = next;
        }
        slope = n * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      at[i] = (x + 1) / 2;
      weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
  static const GaussPoints& get() {
    static const GaussPoints points;
    return points;
  }
};

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
  static Scalar weight(int q) { return GaussPoints<Scalar, points>::get().weight[q]; }

  // F of density(q) dξ: k + 1 columns.
  template <typename Density>
  Eigen::Matrix2X<Scalar> forces(const Density& density) const;
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
  Matrix gram_inverse_;                 // G⁻¹
};

template <typename Scalar>
CurvedSide<Scalar>::CurvedSide(std::span<const Eigen::Vector2d> points_mm, int degree)
    : degree_(degree), a_(points_mm.front().cast<Scalar>()), b_(points_mm.back().cast<Scalar>()) {
  const auto& gauss = GaussPoints<Scalar, points>::get();
  const int n = static_cast<int>(points_mm.size()) - 1, k = degree_;
  for (int q = 0; q < points; ++q) {
    const LagrangeBasis<Scalar> basis(n, gauss.at[q]);
    Vector tangent = Vector::Zero();
    at_[q] = Vector::Zero();
    for (int i = 0; i <= n; ++i) {
      at_[q] += basis.value[i] * points_mm[i].template cast<Scalar>();
      tangent += basis.derivative[i] * points_mm[i].template cast<Scalar>();
    }
    normal_[q] = Vector(tangent.y(), -tangent.x());

    const Vector chord = b_ - a_, from_a = at_[q] - a_;
    const Scalar square = chord.squaredNorm();
    const Vector z(from_a.dot(chord) / square,
                   (chord.x() * from_a.y() - chord.y() * from_a.x()) / square);
    const auto times = [](const Vector& u, const Vector& v) {
      return Vector(u.x() * v.x() - u.y() * v.y(), u.x() * v.y() + u.y() * v.x());
    };
    complex_[q].resize(2, k + 1);
    for (int j = 0; j <= k; ++j) {
      Vector value(Scalar(binomial(k, j)), Scalar(0));
      for (int i = 0; i < j; ++i) value = times(value, z);
      for (int i = j; i < k; ++i) value = times(value, Vector(1 - z.x(), -z.y()));
      complex_[q].col(j) = value;
    }
  }
  Matrix gram(k + 1, k + 1);
  for (int i = 0; i <= k; ++i)
    for (int j = 0; j <= k; ++j)
      gram(i, j) = Scalar((k + 1) * binomial(k, i) * binomial(k, j)) /
                   Scalar((2 * k + 1) * binomial(2 * k, i + j));
  gram_inverse_ = gram.llt().solve(Matrix::Identity(k + 1, k + 1));
}

template <typename Scalar>
template <typename Density>
Eigen::Matrix2X<Scalar> CurvedSide<Scalar>::forces(const Density& density) const {
  Eigen::Matrix2X<Scalar> moments = Eigen::Matrix2X<Scalar>::Zero(2, degree_ + 1);
  for (int q = 0; q < points; ++q) {
    const Vector force = weight(q) * density(q);
    for (int j = 0; j <= degree_; ++j) {
      const auto phi = complex_[q].col(j);
      moments(0, j) += phi(0) * force.x() + phi(1) * force.y();
      moments(1, j) += phi(0) * force.y() - phi(1) * force.x();
    }
  }
  return moments * gram_inverse_;  // symmetric
}

template <typename Scalar>
Eigen::VectorX<Scalar> CurvedSide<Scalar>::bernstein(const Vector& centroid, int q,
                                                     const Scalar& rho) const {
  const auto cross = [](const Vector& u, const Vector& v) { return u.x() * v.y() - u.y() * v.x(); };
  const Scalar whole = cross(b_ - a_, centroid - a_);
  const Scalar first = rho * cross(b_ - at_[q], centroid - at_[q]) / whole,
               second = rho * cross(at_[q] - a_, centroid - a_) / whole, last = 1 - first - second;
  Eigen::VectorX<Scalar> values(bernstein_count(degree_));
  for (int c = 0; c <= degree_; ++c)
    for (int b = 0; b <= degree_ - c; ++b) {
      Scalar value = Scalar(binomial(degree_, b) * binomial(degree_ - b, c));
      for (int i = 0; i < degree_ - b - c; ++i) value *= first;
      for (int i = 0; i < b; ++i) value *= second;
      for (int i = 0; i < c; ++i) value *= last;
      values(ring_place(degree_, b, c)) = value;
    }
  return values;
}

template <typename Scalar>
typename CurvedSide<Scalar>::Matrix CurvedSide<Scalar>::stress_forces(
    const Vector& centroid) const {
  const int count = bernstein_count(degree_);
  Matrix result(2 * (degree_ + 1), 3 * count);
  std::array<Eigen::VectorX<Scalar>, points> value;
  for (int q = 0; q < points; ++q) value[q] = bernstein(centroid, q, Scalar(1));
  for (int i = 0; i < count; ++i)
    for (int component = 0; component < 3; ++component)
      result.col(3 * i + component) = forces([&](int q) {
                                        const Vector& n = normal_[q];
                                        const Scalar of = value[q](i);
                                        if (component == 0) return Vector(of * n.x(), Scalar(0));
                                        if (component == 1) return Vector(Scalar(0), of * n.y());
                                        return Vector(of * n.y(), of * n.x());
                                      }).reshaped();
  return result;
}

template <typename Scalar>
typename CurvedSide<Scalar>::Matrix CurvedSide<Scalar>::mass_root(const Vector& centroid) const {
  const auto& across = GaussPoints<Scalar, layers>::get();
  const int count = bernstein_count(degree_);
  Matrix mass = Matrix::Zero(count, count);  // well conditioned
  for (int q = 0; q < points; ++q)
    for (int l = 0; l < layers; ++l) {
      const Scalar rho = across.at[l];
      const Scalar area = rho * across.weight[l] * weight(q) * (at_[q] - centroid).dot(normal_[q]);
      const Eigen::VectorX<Scalar> values = bernstein(centroid, q, rho);
      mass += area * values * values.transpose();
    }
  return mass.llt().matrixU();
}

}  // namespace airybench
