// The distance of stresses from a closed form.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

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

// ‖σ − exact‖ / ‖exact‖ over the body, up to the curves that the stresses follow.
inline double true_error(const Problem& problem, const StressField& stress,
                         const ExactStress& exact) {
  using Side = CurvedSide<double>;
  const int k = stress.degree(), n = bernstein_count(k);
  double error = 0, norm = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Vector2d centroid = v.rowwise().mean();
    const Eigen::Matrix3d& C = problem.compliance_of(t);
    const CurvedSides curves = problem.curves_of(t, k).value_or(CurvedSides{});
    for (int third = 0; third < 3; ++third) {
      const std::vector<Eigen::Vector2d> chord = {v.col(third), v.col((third + 1) % 3)};
      const Side side(
          {curves[third].is_straight() ? std::span(chord) : curves[third].points_mm, {}, {}}, k);
      const auto own = stress[static_cast<std::size_t>(t)].middleCols(n * third, n);
      for (int q = 0; q < Side::points; ++q)
        for (int l = 0; l < Side::max_layers; ++l) {
          const auto [rho, area] = side.layer(centroid, q, l);
          const Eigen::Vector3d truth = exact(centroid + rho * (side.at(q) - centroid)),
                                off = own * side.bernstein(centroid, q, rho) - truth;
          error += area * off.dot(C * off);
          norm += area * truth.dot(C * truth);
        }
    }
  }
  return std::sqrt(error / norm);
}

}  // namespace airybench::testing
