#include "assembly/curved_traces.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assembly/elements/edge_forces.hpp"

namespace airybench {
namespace {

// The zeros of P_p′ and the ends, on [0, 1].
std::vector<double> gauss_lobatto_points(int p) {
  std::vector<double> inner;
  if (p == 2) {
    inner = {0};
  } else if (p == 3) {
    inner = {std::sqrt(1. / 5)};
  } else if (p == 4) {
    inner = {0, std::sqrt(3. / 7)};
  } else {
    static_assert(highest_stress_degree == 4);
    const double root = 2 * std::sqrt(7.) / 21;
    inner = {std::sqrt(1. / 3 - root), std::sqrt(1. / 3 + root)};
  }
  std::vector<double> points = {0, 1};
  for (const double x : inner)
    for (const int sign : {-1, 1})
      if (x != 0 || sign == 1) points.push_back((1 + sign * x) / 2);
  std::ranges::sort(points);
  return points;
}

// Derivatives at the points of CurvedSide of the polynomial with values there.
const Eigen::MatrixXd& differentiation() {
  static const Eigen::MatrixXd matrix = [] {
    constexpr int n = CurvedSide<double>::points;
    const auto xi = [](int q) { return CurvedSide<double>::xi(q); };
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        if (i == j) continue;
        double value = 1 / (xi(j) - xi(i));
        for (int m = 0; m < n; ++m)
          if (m != i && m != j) value *= (xi(i) - xi(m)) / (xi(j) - xi(m));
        result(i, j) = value;
        result(i, i) -= value;
      }
    return result;
  }();
  return matrix;
}

bool has_traces(const Problem& problem, int row) {
  return row != Problem::no_row && problem.mesh.boundary[row].role != BoundaryRole::force;
}

}  // namespace

DisplacementTriangle::Stiffness CurvedTraces::Map::of_traces(
    const DisplacementTriangle::Stiffness& K) const {
  return to_coefficients.transpose().lazyProduct(K.lazyProduct(to_coefficients).eval());
}

CurvedTraces::CurvedTraces(const Problem& problem, int degree, Sides sides)
    : problem_(problem), degree_(degree) {
  if (problem.round.empty() || sides == Sides::chords) return;
  const auto& element = DisplacementTriangle::of_degree(degree);
  const std::vector<double> points = gauss_lobatto_points(degree);
  Eigen::MatrixXd bernstein(degree + 1, degree + 1);
  for (int q = 0; q <= degree; ++q)
    for (int i = 0; i <= degree; ++i) bernstein(q, i) = bernstein_polynomial(degree, i, points[q]);
  to_bernstein_ = bernstein.partialPivLu().inverse();
  for (const Problem::RoundTriangle& round : problem.round) {
    const TriangleVertices v = problem.vertices_of(round.triangle);
    const TriangleShape shape(v);
    std::optional<Eigen::MatrixXd> D;
    for (int e = 0; e < 3; ++e) {
      const int row = round.rows[e];
      if (!has_traces(problem, row)) continue;
      const SideCurve curve = problem.curve_of(row, degree);
      Side& side = sides_[row];
      for (int q = 0; q <= degree; ++q) {
        const CurvePoint<double> point(curve, points[q]);
        side.at.push_back(point.at);
        side.frames.push_back(point.frame);
        Eigen::Matrix2d own = Eigen::Matrix2d::Identity();
        if (!curve.law_normals.empty()) {
          const EdgeFrame frame = problem.frame_on_curve(row, q, degree);
          own << frame.normal, frame.tangent;
        }
        side.of_coefficients.push_back(own);
      }
      if (!D) D = Eigen::MatrixXd::Identity(2 * element.nodes, 2 * element.nodes);
      for (int i = 1; i < degree; ++i) {
        auto rows = D->middleRows<2>(2 * element.on_edge(e, i));
        rows.setZero();
        for (int q = 0; q <= degree; ++q) {
          const Eigen::VectorXd value = element.values(shape, side.at[q] - v.col(0));
          const Eigen::Matrix2d turn =
              to_bernstein_(i, q) * side.of_coefficients[i].lazyProduct(side.frames[q].transpose());
          for (int m = 0; m < element.nodes; ++m) rows.middleCols<2>(2 * m) += value(m) * turn;
        }
      }
    }
    if (D) maps_[round.triangle] = {*D, D->partialPivLu().inverse()};
  }
}

const CurvedTraces::Map* CurvedTraces::of(int triangle) const {
  const auto found = maps_.find(triangle);
  return found == maps_.end() ? nullptr : &found->second;
}

const CurvedTraces::Side* CurvedTraces::side_of(int row) const {
  const auto found = sides_.find(row);
  return found == sides_.end() ? nullptr : &found->second;
}

DisplacementField CurvedTraces::mapped(const DisplacementField& field,
                                       Eigen::MatrixXd Map::*map) const {
  DisplacementField result = field;
  for (const auto& [t, maps] : maps_) {
    const auto nodes = triangle_nodes(problem_, degree_, t);
    const Eigen::VectorXd own = of_triangle(problem_, degree_, field, t).reshaped(),
                          changed = (maps.*map).lazyProduct(own);
    for (std::size_t m = 0; m < nodes.size(); ++m)
      result.col(nodes[m]) = changed.segment<2>(2 * static_cast<Eigen::Index>(m));
  }
  return result;
}

Eigen::Matrix2Xd CurvedTraces::forces(Eigen::Matrix2Xd of_coefficients) const {
  for (const auto& [t, maps] : maps_) {
    const auto nodes = triangle_nodes(problem_, degree_, t);
    const Eigen::VectorXd changed = maps.to_coefficients.transpose().lazyProduct(
        of_triangle(problem_, degree_, of_coefficients, t).reshaped());
    for (std::size_t m = 0; m < nodes.size(); ++m)
      of_coefficients.col(nodes[m]) = changed.segment<2>(2 * static_cast<Eigen::Index>(m));
  }
  return of_coefficients;
}

Eigen::Matrix2Xd CurvedTraces::traces_on(int row, const AlongCurve& u) const {
  if (const Side* side = side_of(row)) return interpolant(*side, u);
  const auto [start, end] = problem_.mesh.boundary[row].vertices;
  const auto &a = problem_.mesh.vertices[start], &b = problem_.mesh.vertices[end];
  Eigen::Matrix2Xd d(2, degree_ + 1);
  for (int i = 0; i <= degree_; ++i) d.col(i) = u(a + i * (b - a) / degree_);
  return d;
}

Eigen::Matrix2Xd CurvedTraces::interpolant(const Side& side, const AlongCurve& u) const {
  Eigen::Matrix2Xd d = Eigen::Matrix2Xd::Zero(2, degree_ + 1);
  for (int q = 0; q <= degree_; ++q) {
    const Eigen::Vector2d own = side.frames[q].transpose() * u(side.at[q]);
    for (int i = 0; i <= degree_; ++i) d.col(i) += to_bernstein_(i, q) * own;
  }
  for (int i = 0; i <= degree_; ++i) d.col(i) = (side.of_coefficients[i] * d.col(i)).eval();
  return d;
}

PrescribedDisplacement CurvedTraces::prescribed() const {
  PrescribedDisplacement prescribed = prescribed_displacement(
      problem_, degree_, [&](int row, int i) { return frame(row, i).normal; });
  const auto& u0 = problem_.loads.displacement_mm;
  if (!u0) return prescribed;
  for (const auto& entry : sides_) {
    const int row = entry.first;
    if (problem_.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const Eigen::Matrix2Xd u =
        interpolant(entry.second, [&](const Eigen::Vector2d& x) { return u0(x, row); });
    const auto nodes = with_degree(degree_ - 1, [&](auto k) {
      const auto of_row = boundary_nodes<k + 1>(problem_, row);
      return std::vector<int>(of_row.begin(), of_row.end());
    });
    for (int i = 1; i < degree_; ++i) {
      const Eigen::Vector2d n = frame(row, i).normal;
      prescribed.u.col(nodes[i]) =
          problem_.is_roller(row) ? Eigen::Vector2d(n * n.dot(u.col(i))) : u.col(i);
    }
  }
  return prescribed;
}

double CurvedTraces::squared_distance(int triangle, const StressCoefficients& stress,
                                      const DisplacementTriangle::Displacement& w) const {
  using Points = CurvedThird<double>;
  const int k = degree_ - 1;
  const Eigen::Index third = bernstein_count(k);
  const auto& element = DisplacementTriangle::of_degree(degree_);
  const TriangleVertices v = problem_.vertices_of(triangle);
  const TriangleShape shape(v);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  const Eigen::Matrix3d& compliance = problem_.compliance_of(triangle);
  const Eigen::Matrix3d elasticity = elasticity_of(compliance);
  const CurvedSides curves = *problem_.curves_of(triangle, degree_);
  const Eigen::Matrix2Xd d =
      maps_.at(triangle).to_traces.lazyProduct(w.reshaped()).reshaped(2, w.cols());
  const Problem::RoundTriangle& round =
      *std::ranges::lower_bound(problem_.round, triangle, {}, &Problem::RoundTriangle::triangle);
  double sum = 0;
  for (int e = 0; e < 3; ++e) {
    const std::vector<Eigen::Vector2d> chord = {v.col(e), v.col((e + 1) % 3)};
    const SideCurve curve = curves[e].is_straight() ? SideCurve{chord, {}, {}} : curves[e];
    const Points side({curve.points_mm, {}, {}}, k);
    // What w is more on the side than the interpolant, and its derivative.
    Eigen::MatrixX2d more = Eigen::MatrixX2d::Zero(Points::points, 2), slope = more;
    if (has_traces(problem_, round.rows[e])) {
      const Side& own = *side_of(round.rows[e]);
      for (int q = 0; q < Points::points; ++q) {
        Eigen::Vector2d interpolated = Eigen::Vector2d::Zero();
        for (int i = 0; i <= degree_; ++i)
          interpolated += bernstein_polynomial(degree_, i, Points::xi(q)) *
                          (own.of_coefficients[i].transpose() * d.col(element.on_edge(e, i)));
        more.row(q) = w.lazyProduct(element.values(shape, side.at(q) - v.col(0))) -
                      CurvePoint<double>(curve, Points::xi(q)).frame.lazyProduct(interpolated);
      }
      slope = differentiation().lazyProduct(more);
    }
    const auto of_third = stress.middleCols(third * e, third);
    for (int q = 0; q < Points::points; ++q)
      for (int l = 0; l <= k; ++l) {
        const auto [rho, area] = side.layer(centroid, q, l, k + 1);
        Eigen::Matrix2d J, gradient;  // of x, and of ρ² times what is more, to ρ and ξ
        J << side.at(q) - centroid, rho * Eigen::Vector2d(-side.normal(q).y(), side.normal(q).x());
        gradient << 2 * rho * more.row(q).transpose(), rho * rho * slope.row(q).transpose();
        const Eigen::Matrix2d g = gradient * J.inverse();
        const Eigen::Vector3d s = of_third * side.bernstein(centroid, q, rho) +
                                  elasticity * Eigen::Vector3d(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
        sum += area * s.dot(compliance * s);
      }
  }
  return sum;
}

}  // namespace airybench
