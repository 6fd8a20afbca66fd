// Smooth elastic fields from complex functions, and their moments and stresses on elements of any
// degree.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>
#include <vector>

#include "assembly/elements/elasticity.hpp"
#include "assembly/elements/equilibrium_element.hpp"

namespace airybench::testing {

using Complex = std::complex<double>;
using Gauss = boost::math::quadrature::gauss<double, 10>;

inline double bernstein(int k, int j, double s) {
  return binomial(k, j) * std::pow(s, j) * std::pow(1 - s, k - j);
}

// Plane strain without body force (Kolosov 1909), z = x + iy:
//   2G (u + iv) = κ f − z f̄' − ḡ,   σxx + σyy = 4 Re f',   σyy − σxx + 2i σxy = 2 (z̄ f'' + g')
struct KolosovField {
  double poisson;
  std::function<std::array<Complex, 3>(Complex)> f;  // f, f', f''
  std::function<std::array<Complex, 2>(Complex)> g;  // g, g'

  static constexpr double young = 210000;
  Eigen::Matrix3d C() const { return compliance({young, poisson}, Plane::strain); }
  Complex displacement(Complex z) const {
    const auto [f0, f1, f2] = f(z);
    return ((3 - 4 * poisson) * f0 - z * std::conj(f1) - std::conj(g(z)[0])) *
           ((1 + poisson) / young);
  }
  Eigen::Vector3d stress(Complex z) const {
    const auto [f0, f1, f2] = f(z);
    const double sum = 4 * f1.real();
    const Complex difference = 2. * (std::conj(z) * f2 + g(z)[1]);
    return {(sum - difference.real()) / 2, (sum + difference.real()) / 2, difference.imag() / 2};
  }
};

// Stresses of degree m.
inline KolosovField polynomial(int m, double poisson) {
  const Complex a(0.7, -0.4), b(-0.3, 0.9);
  const double n = m + 1;
  return {poisson,
          [=](Complex z) -> std::array<Complex, 3> {
            return {a * std::pow(z, m + 1), a * n * std::pow(z, m),
                    m == 0 ? 0 : a * n * double(m) * std::pow(z, m - 1)};
          },
          [=](Complex z) -> std::array<Complex, 2> {
            return {b * std::pow(z, m + 1), b * n * std::pow(z, m)};
          }};
}

inline KolosovField smooth(double poisson) {
  return {poisson,
          [](Complex z) -> std::array<Complex, 3> {
            return {std::exp(z), std::exp(z), std::exp(z)};
          },
          [](Complex z) -> std::array<Complex, 2> {
            const Complex i(0, 1);
            return {std::exp(i * z), i * std::exp(i * z)};
          }};
}

inline Complex point(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

// Moments of edge a→b, x and y at each.
template <int k>
Eigen::Matrix<double, 2, k + 1> moments(const KolosovField& field, const Eigen::Vector2d& a,
                                        const Eigen::Vector2d& b) {
  Eigen::Matrix<double, 2, k + 1> u;
  for (int j = 0; j <= k; ++j) {
    const auto part = [&](auto of) {
      return (k + 1) * Gauss::integrate(
                           [&](double s) {
                             return bernstein(k, j, s) *
                                    of(field.displacement(point((1 - s) * a + s * b)));
                           },
                           0., 1.);
    };
    u.col(j) << part([](Complex w) { return w.real(); }), part([](Complex w) { return w.imag(); });
  }
  return u;
}

// A stress at barycentric coordinates of third t.
template <int k>
Eigen::Vector3d stress_at(const typename EquilibriumElement<double, k>::Stress& stress, int t,
                          const Eigen::Vector3d& lambda) {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int c = 0; c <= k; ++c)
    for (int b = 0; b <= k - c; ++b) {
      const int a = k - b - c;
      const double weight = std::tgamma(k + 1) / std::tgamma(a + 1) / std::tgamma(b + 1) /
                            std::tgamma(c + 1) * std::pow(lambda(0), a) * std::pow(lambda(1), b) *
                            std::pow(lambda(2), c);
      value += weight * stress.col(StressDegree<k>::third * t + ring_place(k, b, c));
    }
  return value;
}

// Visits points of the element with third, barycentric coordinates there, place and weight in mm²:
// of Gauss's rule on squares collapsed to thirds.
template <typename Visit>
void visit_points(const TriangleVertices& v, Visit visit) {
  std::vector<std::pair<double, double>> rule;  // on 0 … 1
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
    for (const double sign : {-1., 1.})
      rule.emplace_back((1 + sign * Gauss::abscissa()[i]) / 2, Gauss::weights()[i] / 2);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  for (int t = 0; t < 3; ++t) {
    TriangleVertices third;
    third << v.col(t), v.col((t + 1) % 3), centroid;
    const Eigen::Vector2d a = third.col(1) - third.col(0), b = third.col(2) - third.col(0);
    const double twice_area = a.x() * b.y() - a.y() * b.x();
    for (const auto& [x, w_x] : rule)
      for (const auto& [y, w_y] : rule) {
        const Eigen::Vector3d lambda((1 - x) * (1 - y), x * (1 - y), y);
        visit(t, lambda, Eigen::Vector2d(third * lambda), w_x * w_y * (1 - y) * twice_area);
      }
  }
}

}  // namespace airybench::testing
