// The distance of stresses from a closed form.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>

#include "assembly/stress_field.hpp"

namespace airybench::testing {

using ExactStress = std::function<Eigen::Vector3d(const Eigen::Vector2d&)>;

// (xx, yy, xy) of components along and across x.
inline Eigen::Vector3d from_polar(double rr, double tt, double rt, const Eigen::Vector2d& x) {
  const double c = x.x() / x.norm(), s = x.y() / x.norm();
  return {rr * c * c + tt * s * s - 2 * rt * c * s, rr * s * s + tt * c * c + 2 * rt * c * s,
          (rr - tt) * c * s + rt * (c * c - s * s)};
}

// At b V_(t+1) + c V4 of a third t.
inline Eigen::Vector3d value_at(const StressField& stress, std::size_t t, int third, double b,
                                double c) {
  const int k = stress.degree();
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int m = 0; m <= k; ++m)
    for (int l = 0; l <= k - m; ++l)
      value += binomial(k, l) * binomial(k - l, m) * std::pow(1 - b - c, k - l - m) *
               std::pow(b, l) * std::pow(c, m) *
               stress[t].col(bernstein_count(k) * third + ring_place(k, l, m));
  return value;
}

// ‖σ − exact‖ / ‖exact‖ over the straight triangles.
inline double true_error(const Problem& problem, const StressField& stress,
                         const ExactStress& exact) {
  using Points = boost::math::quadrature::gauss<double, 7>;
  double error = 0, norm = 0;
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const TriangleVertices v = problem.vertices_of(static_cast<int>(t));
    const Eigen::Vector2d centroid = v.rowwise().mean();
    const Eigen::Matrix3d& C = problem.compliance_of(static_cast<int>(t));
    for (int third = 0; third < 3; ++third) {
      const Eigen::Vector2d a = v.col(third), d = v.col((third + 1) % 3);
      const double area = problem.area_mm2(static_cast<int>(t)) / 3;
      const auto integral = [&](auto value) {
        return 2 * area *
               Points::integrate(
                   [&](double c) {
                     return (1 - c) * Points::integrate(
                                          [&](double s) {
                                            const double b = s * (1 - c);
                                            const Eigen::Vector2d x =
                                                (1 - b - c) * a + b * d + c * centroid;
                                            const Eigen::Vector3d of = value(x, b, c);
                                            return of.dot(C * of);
                                          },
                                          0., 1.);
                   },
                   0., 1.);
      };
      error += integral([&](const Eigen::Vector2d& x, double b, double c) {
        return Eigen::Vector3d(value_at(stress, t, third, b, c) - exact(x));
      });
      norm += integral([&](const Eigen::Vector2d& x, double, double) { return exact(x); });
    }
  }
  return std::sqrt(error / norm);
}

}  // namespace airybench::testing
