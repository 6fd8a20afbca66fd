// Mean tractions of the edges of a contact face, and the ellipse through them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "assembly/problem/problem.hpp"
#include "solvers/contact/paired_points.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::testing {

struct EdgeTraction {
  Eigen::Vector2d start, end;  // mm
  double pressure, shear;      // MPa; |shear|
  double length() const { return (end - start).norm(); }
  Eigen::Vector2d middle() const { return (start + end) / 2; }
};

// Of a wall's face, or of the first one of a pair.
inline std::vector<EdgeTraction> edge_tractions(const Problem& problem, const ContactPoints& all,
                                                const Eigen::VectorXd& F_C) {
  const ContactPoints points = joined(all);
  const Eigen::VectorXd F = of_first(all, F_C);
  const int n = points.per_edge, m = points.components;
  std::vector<EdgeTraction> edges;
  for (int p = 0; p < points.count; p += n) {
    const auto [a, b] =
        problem.mesh.boundary[static_cast<std::size_t>(points.boundary[p])].vertices;
    const Eigen::Vector2d start = problem.mesh.vertices[a], end = problem.mesh.vertices[b];
    const Eigen::Map<const Eigen::MatrixXd> of_points(&F(m * p), m, n);
    const Eigen::VectorXd mean = of_points.rowwise().sum() / (end - start).norm();
    edges.push_back({start, end, -mean(0), m > 1 ? std::abs(mean(1)) : 0});
  }
  return edges;
}

// y² = A + B x + C x² through the edges with y above `least` times the largest: the half width of
// an ellipse of pressure and its height.
struct Ellipse {
  double half_width, height;
};
template <typename Y>
Ellipse fitted(const std::vector<EdgeTraction>& edges, double least, const Y& y) {
  double largest = 0;
  for (const EdgeTraction& edge : edges) largest = std::max(largest, std::invoke(y, edge));
  std::vector<Eigen::Vector4d> rows;
  for (const EdgeTraction& edge : edges)
    if (const double x = edge.middle().x(), value = std::invoke(y, edge); value > least * largest)
      rows.emplace_back(1, x, x * x, value * value);
  const Eigen::Map<const Eigen::Matrix4Xd> all(rows.front().data(), 4,
                                               static_cast<Eigen::Index>(rows.size()));
  const Eigen::VectorXd c = least_squares(all.topRows<3>().transpose(), all.row(3).transpose());
  const double height_squared = c(0) - c(1) * c(1) / (4 * c(2));
  return {std::sqrt(-height_squared / c(2)), std::sqrt(height_squared)};
}

}  // namespace airybench::testing
