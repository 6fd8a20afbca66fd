#include "mesh/edge_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "support/lagrange.hpp"

namespace airybench {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector2d sum(const std::vector<double>& weights, const Points& points) {
  Eigen::Vector2d result = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) result += weights[i] * points[i];
  return result;
}

// Bernstein coefficients of (x − origin) × x′, of degree 2n − 1.
std::vector<double> swept(const EdgeCurve& curve, const Eigen::Vector2d& origin) {
  const int n = curve.degree();
  Eigen::MatrixXd bernstein(n + 1, n + 1), points(n + 1, 2);
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    points.row(i) = (curve.points_mm[static_cast<std::size_t>(i)] - origin).transpose();
    for (int j = 0; j <= n; ++j)
      bernstein(i, j) = binomial(n, j) * std::pow(t, j) * std::pow(1 - t, n - j);
  }
  const Eigen::MatrixXd x = bernstein.partialPivLu().solve(points);
  std::vector<double> result(2 * static_cast<std::size_t>(n), 0);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < n; ++j)
      result[static_cast<std::size_t>(i + j)] += binomial(n, i) * binomial(n - 1, j) /
                                                 binomial(2 * n - 1, i + j) *
                                                 cross(x.row(i), n * (x.row(j + 1) - x.row(j)));
  return result;
}

}  // namespace

Eigen::Vector2d EdgeCurve::at(double t) const {
  if (t == 0) return points_mm.front();
  if (t == 1) return points_mm.back();
  return sum(LagrangeBasis<double>(degree(), t).value, points_mm);
}

Eigen::Vector2d EdgeCurve::normal(double t) const {
  const Eigen::Vector2d tangent = derivative(t).normalized();
  return {tangent.y(), -tangent.x()};
}

Eigen::Vector2d EdgeCurve::derivative(double t) const {
  return sum(LagrangeBasis<double>(degree(), t).derivative, points_mm);
}

EdgeCurve EdgeCurve::between(double first, double last) const {
  EdgeCurve part;
  for (int i = 0; i < degree(); ++i)
    part.points_mm.push_back(at(first + (last - first) * i / degree()));
  part.points_mm.push_back(at(last));
  return part;
}

double EdgeCurve::parameter_on_line(const Eigen::Vector2d& p, const Eigen::Vector2d& d) const {
  constexpr int max_steps = 20;
  constexpr double rounding = 1e-15;
  const double across = cross(chord(), d);
  double t = cross(p - points_mm.front(), d) / across;  // on the chord
  for (int step = 0; step < max_steps; ++step) {
    const double miss = cross(at(t) - p, d);
    if (std::abs(miss) <= rounding * std::abs(across)) break;
    t -= miss / cross(derivative(t), d);
  }
  return t;
}

void EdgeCurve::move_ends(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  const Eigen::Vector2d by = start - points_mm.front(), of_end = end - points_mm.back();
  for (int i = 0; i <= degree(); ++i) {
    const double s = static_cast<double>(i) / degree();
    points_mm[static_cast<std::size_t>(i)] += (1 - s) * by + s * of_end;
  }
  points_mm.front() = start;
  points_mm.back() = end;
}

double EdgeCurve::sagitta() const {
  double largest = 0;
  for (const double t : {0.25, 0.5, 0.75})
    largest = std::max(largest, std::abs(cross(chord(), at(t) - points_mm.front())));
  return largest / chord().norm();
}

// ½ ∫ (x − p_0) × x′ dt; the integral of a Bernstein polynomial of degree 2n − 1 is 1/(2n).
double segment_area(const EdgeCurve& curve) {
  double twice_area = 0;
  for (const double c : swept(curve, curve.points_mm.front()))
    twice_area += c / (2 * curve.degree());
  return twice_area / 2;
}

bool fits(const EdgeCurve& ab, const Eigen::Vector2d& c) {
  constexpr double least = 0.1;  // of the chord's: 0.18 was accurate in tests, −0.16 was not
  const Eigen::Vector2d centroid = (ab.points_mm.front() + ab.points_mm.back() + c) / 3;
  const double of_chord = cross(ab.points_mm.front() - centroid, ab.chord());
  return std::ranges::all_of(swept(ab, centroid),
                             [&](double of_curve) { return of_curve > least * of_chord; });
}

}  // namespace airybench
