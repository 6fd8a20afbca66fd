#include "assembly/elements/curved_side.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "assembly/elements/bernstein.hpp"
#include "support/lagrange.hpp"

namespace airybench {
namespace {

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

// B_j of degree k.
template <typename Scalar>
Scalar bernstein_polynomial(int k, int j, const Scalar& xi) {
  Scalar value = binomial(k, j);
  for (int i = 0; i < j; ++i) value *= xi;
  for (int i = j; i < k; ++i) value *= 1 - xi;
  return value;
}

}  // namespace

template <typename Scalar>
CurvedSide<Scalar>::CurvedSide(std::span<const Eigen::Vector2d> points_mm, int degree)
    : degree_(degree), a_(points_mm.front().cast<Scalar>()), b_(points_mm.back().cast<Scalar>()) {
  const auto& gauss = GaussPoints<Scalar, points>::get();
  using std::sqrt;
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
  Matrix values(points, k + 1);  // exact: B_i B_j are of degree 2k
  for (int q = 0; q < points; ++q)
    for (int j = 0; j <= k; ++j)
      values(q, j) = sqrt(Scalar(k + 1) * weight(q)) * bernstein_polynomial(k, j, gauss.at[q]);
  gram_ = GramRoot<Scalar>(values);
}

template <typename Scalar>
const Scalar& CurvedSide<Scalar>::weight(int q) {
  return GaussPoints<Scalar, points>::get().weight[q];
}

template <typename Scalar>
Eigen::Matrix2X<Scalar> CurvedSide<Scalar>::forces(const Eigen::Matrix2X<Scalar>& density) const {
  Eigen::Matrix2X<Scalar> moments = Eigen::Matrix2X<Scalar>::Zero(2, degree_ + 1);
  for (int q = 0; q < points; ++q) {
    const Vector force = weight(q) * density.col(q);
    for (int j = 0; j <= degree_; ++j) {
      const auto phi = complex_[q].col(j);
      moments(0, j) += phi(0) * force.x() + phi(1) * force.y();
      moments(1, j) += phi(0) * force.y() - phi(1) * force.x();
    }
  }
  Matrix forces = moments.transpose();
  for (int x = 0; x < 2; ++x) gram_.solve(&forces(0, x));
  return forces.transpose();
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
    for (int component = 0; component < 3; ++component) {
      Eigen::Matrix2X<Scalar> density = Eigen::Matrix2X<Scalar>::Zero(2, points);
      for (int q = 0; q < points; ++q) {
        if (component != 1) density(component / 2, q) = value[q](i) * normal_[q].x();
        if (component != 0) density(1 - component / 2, q) = value[q](i) * normal_[q].y();
      }
      result.col(3 * i + component) = forces(density).reshaped();
    }
  return result;
}

template <typename Scalar>
typename CurvedSide<Scalar>::Matrix CurvedSide<Scalar>::mass_root(const Vector& centroid) const {
  const auto& across = GaussPoints<Scalar, layers>::get();
  using std::sqrt;
  Matrix rows(points * layers, bernstein_count(degree_));
  for (int q = 0; q < points; ++q)
    for (int l = 0; l < layers; ++l) {
      const Scalar rho = across.at[l];
      const Scalar area = rho * across.weight[l] * weight(q) * (at_[q] - centroid).dot(normal_[q]);
      rows.row(q * layers + l) = sqrt(area) * bernstein(centroid, q, rho).transpose();
    }
  return GramRoot<Scalar>(std::move(rows)).R();
}

template class CurvedSide<double>;
template class CurvedSide<Wide>;

}  // namespace airybench
