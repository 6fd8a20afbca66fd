// Bernstein polynomials on an edge and on a triangle, as stresses of any degree and their
// displacements are made of.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <type_traits>
#include <utility>

namespace airybench {

// Exact as long as it fits: whole numbers.
constexpr double binomial(int n, int m) {
  double value = 1;
  for (int i = 1; i <= m; ++i) value = value * (n - m + i) / i;
  return value;
}

// Coefficients of degree d on a triangle.
constexpr int bernstein_count(int d) { return (d + 1) * (d + 2) / 2; }

// Place of the coefficient of V1^(d−b−c) V2^b V3^c: by rings, each walked from V1. The d + 1 on the
// edge V1 V2 come first.
constexpr int ring_place(int d, int b, int c) { return c * (d + 1) - c * (c - 1) / 2 + b; }

// B_j of degree k on an edge.
template <typename Scalar>
Scalar bernstein_polynomial(int k, int j, const Scalar& s) {
  Scalar value = binomial(k, j);
  for (int i = 0; i < j; ++i) value *= s;
  for (int i = j; i < k; ++i) value *= 1 - s;
  return value;
}

// All B_α of degree d at barycentric coordinates, by ring_place(); beyond the triangle, too.
template <typename Scalar>
Eigen::VectorX<Scalar> bernstein_values(int d, const Eigen::Vector3<Scalar>& lambda) {
  Eigen::VectorX<Scalar> values(bernstein_count(d));
  for (int c = 0; c <= d; ++c)
    for (int b = 0; b <= d - c; ++b) {
      Scalar value = Scalar(binomial(d, b) * binomial(d - b, c));
      for (int i = 0; i < d - b - c; ++i) value *= lambda(0);
      for (int i = 0; i < b; ++i) value *= lambda(1);
      for (int i = 0; i < c; ++i) value *= lambda(2);
      values(ring_place(d, b, c)) = value;
    }
  return values;
}

// ∫ B_α B_β over a triangle of area a = a Π binom(α_p + β_p, α_p) / (binom(2d, d) binom(2d+2, 2)).
template <typename Scalar>
Eigen::MatrixX<Scalar> bernstein_mass(int d, Scalar area) {
  Eigen::MatrixX<Scalar> m(bernstein_count(d), bernstein_count(d));
  const double scale = binomial(2 * d, d) * binomial(2 * d + 2, 2);
  const auto for_all = [&](auto visit) {
    for (int c = 0; c <= d; ++c)
      for (int b = 0; b <= d - c; ++b) visit(ring_place(d, b, c), d - b - c, b, c);
  };
  for_all([&](int i, int a1, int b1, int c1) {
    for_all([&](int j, int a2, int b2, int c2) {
      m(i, j) = area *
                Scalar(binomial(a1 + a2, a1) * binomial(b1 + b2, b1) * binomial(c1 + c2, c1)) /
                Scalar(scale);
    });
  });
  return m;
}

// (k + 1)/L ∫ B_j of degree k times B_i of degree p, over an edge: the moment j of a displacement,
// and the force on a coefficient, from those of the traction's control values.
constexpr double edge_moment(int k, int j, int p, int i) {
  return (k + 1.) / (k + p + 1) * binomial(k, j) * binomial(p, i) / binomial(k + p, i + j);
}

// Bernstein coefficients of degree p of the polynomial of degree q ≤ p with the coefficients c:
// Σ_j binom(q, j) binom(p − q, i − j) / binom(p, i) c_j.
template <int p, typename Coefficients>
auto elevated(const Coefficients& c) {
  using Value = std::decay_t<decltype(c[0])>;
  const int q = static_cast<int>(std::size(c)) - 1;
  assert(q <= p);
  std::array<Value, p + 1> higher;
  for (int i = 0; i <= p; ++i) {
    const auto weight = [&](int j) {
      return binomial(q, j) * binomial(p - q, i - j) / binomial(p, i);
    };
    const int first = std::max(0, i - p + q), last = std::min(i, q);
    higher[i] = weight(first) * c[first];
    for (int j = first + 1; j <= last; ++j) higher[i] += weight(j) * c[j];
  }
  return higher;
}

// The moments (q + 1)/L ∫ B_j … ds with B_j of degree q < p, from those of degree p.
template <int q, std::size_t size>
std::array<double, q + 1> lower_moments(const std::array<double, size>& moments) {
  constexpr int p = static_cast<int>(size) - 1;
  std::array<double, q + 1> lower{};
  for (int j = 0; j <= q; ++j)
    for (int i = j; i <= j + p - q; ++i)
      lower[j] += (q + 1.) / (p + 1) * binomial(q, j) * binomial(p - q, i - j) / binomial(p, i) *
                  moments[i];
  return lower;
}

// Moment (k + 1)/L ∫ B_j q ds over an edge, B_j of degree k, q with these Bernstein coefficients.
template <typename Value, std::size_t size>
Value moment_of(int k, int j, const std::array<Value, size>& q) {
  constexpr int p = static_cast<int>(size) - 1;
  Value moment = edge_moment(k, j, p, 0) * q[0];
  for (int i = 1; i <= p; ++i) moment += edge_moment(k, j, p, i) * q[i];
  return moment;
}

// The polynomial with the coefficients c at s = 0 … 1, and the coefficients of its two halves, by
// de Casteljau's steps.
template <typename Coefficients>
auto bernstein_value(Coefficients c, double s) {
  const int degree = static_cast<int>(std::size(c)) - 1;
  for (int step = 1; step <= degree; ++step)
    for (int i = 0; i <= degree - step; ++i) c[i] = (1 - s) * c[i] + s * c[i + 1];
  return std::decay_t<decltype(c[0])>(c[0]);
}
template <typename Coefficients>
std::pair<Coefficients, Coefficients> halved(const Coefficients& c) {
  std::pair<Coefficients, Coefficients> halves{c, c};
  auto& [left, right] = halves;
  const int degree = static_cast<int>(std::size(c)) - 1;
  for (int step = 1; step <= degree; ++step) {
    for (int i = 0; i <= degree - step; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    left[step] = right[0];
  }
  return halves;
}

// Bernstein coefficients of the quadratic through three samples along an edge.
template <typename Value>
std::array<Value, 3> edge_coefficients(const Value& start, const Value& middle, const Value& end) {
  return {start, Value(2 * middle - (start + end) / 2), end};
}

}  // namespace airybench
