// Bernstein polynomials on an edge and on a triangle, as stresses of any degree and their
// displacements are made of.
#pragma once

#include <Eigen/Core>

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

// Moment (k + 1)/L ∫ B_j q ds over an edge, B_j of degree k, q with these Bernstein coefficients of
// degree 2.
template <typename Coefficients>
auto moment_of_quadratic(int k, int j, const Coefficients& q) {
  const auto weight = [&](int i) {
    return (k + 1.) / (k + 3.) * binomial(k, j) * binomial(2, i) / binomial(k + 2, i + j);
  };
  using Value = std::decay_t<decltype(q[0])>;
  return Value(weight(0) * q[0] + weight(1) * q[1] + weight(2) * q[2]);
}

}  // namespace airybench
