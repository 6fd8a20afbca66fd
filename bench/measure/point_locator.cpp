#include "bench/measure/point_locator.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace airybench {
namespace {

constexpr double weight_rounding = 1e-9;  // of a weight

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether V4 + d lies in the third between V4 and a curve: on the ray to x(ξ), not beyond it.
bool is_before_curve(const SideCurve& curve, const Eigen::Vector2d& centroid,
                     const Eigen::Vector2d& d) {
  constexpr int halvings = 52;
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    const bool is_left = cross(CurvePoint<double>(curve, middle).at - centroid, d) > 0;
    (is_left ? low : high) = middle;
  }
  const Eigen::Vector2d side = CurvePoint<double>(curve, low).at - centroid;
  return d.norm() <= (1 + weight_rounding) * side.norm();
}

}  // namespace

PointLocator::PointLocator(const Problem& problem, int degree)
    : problem_(problem), degree_(degree) {
  using Box = Eigen::AlignedBox2d;
  const auto count = static_cast<int>(problem.mesh.triangles.size());
  std::vector<Box> boxes(static_cast<std::size_t>(count));
  Box whole;
  for (int t = 0; t < count; ++t) {
    Box& box = boxes[t];
    for (const int v : problem.mesh.triangles[t]) box.extend(problem.mesh.vertices[v]);
    if (const auto curves = problem.curves_of(t, degree))
      for (const SideCurve& curve : *curves) {
        // Control points of the curve are as far outside as its points are from the chord.
        const double width = curve.is_straight() ? 0 : box.diagonal().norm() / 2;
        for (const Eigen::Vector2d& point : curve.points_mm) box.extend(point);
        if (width > 0) box = Box(box.min().array() - width, box.max().array() + width);
      }
    whole.extend(box);
  }
  corner_ = whole.min();
  const Eigen::Vector2d sizes = whole.sizes();
  size_mm_ = std::max(std::sqrt(sizes.prod() / count), sizes.maxCoeff() / count);
  columns_ = 1 + static_cast<int>(sizes.x() / size_mm_);
  rows_ = 1 + static_cast<int>(sizes.y() / size_mm_);
  squares_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int t = 0; t < count; ++t) {
    const auto [i0, j0] = square_of(boxes[t].min());
    const auto [i1, j1] = square_of(boxes[t].max());
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) squares_[j * columns_ + i].push_back(t);
  }
}

std::pair<int, int> PointLocator::square_of(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d at = (x - corner_) / size_mm_;
  return {static_cast<int>(std::clamp(at.x(), 0., columns_ - 1.)),
          static_cast<int>(std::clamp(at.y(), 0., rows_ - 1.))};
}

std::optional<PointLocator::Place> PointLocator::place_of(const Eigen::Vector2d& x) const {
  if (!x.allFinite()) return {};
  const auto [i, j] = square_of(x);
  for (const int t : in_square(i, j))
    if (const std::optional<Place> place = place_in(t, x)) return place;
  return {};
}

std::optional<PointLocator::Place> PointLocator::place_in(int triangle,
                                                          const Eigen::Vector2d& x) const {
  const TriangleVertices v = problem_.vertices_of(triangle);
  const Eigen::Vector2d centroid = v.rowwise().mean(), d = x - centroid;
  const auto curves = problem_.curves_of(triangle, degree_);
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix2d spokes;
    spokes << v.col(k) - centroid, v.col((k + 1) % 3) - centroid;
    const Eigen::Vector2d along = spokes.inverse() * d;
    if (along.minCoeff() < -weight_rounding) continue;
    const bool is_curved = curves && !(*curves)[static_cast<std::size_t>(k)].is_straight();
    if (is_curved ? is_before_curve((*curves)[static_cast<std::size_t>(k)], centroid, d)
                  : along.sum() <= 1 + weight_rounding)
      return Place{triangle, k, {along(0), along(1), 1 - along.sum()}};
  }
  return {};
}

Eigen::Vector3d stress_at(const PointLocator& locator, const StressField& stress,
                          const Eigen::Vector2d& x) {
  const auto place = locator.place_of(x);
  if (!place) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd values = bernstein_values(stress.degree(), place->weights);
  return stress[static_cast<std::size_t>(place->triangle)].middleCols(place->third * values.size(),
                                                                      values.size()) *
         values;
}

Json values_at_points(const Problem& problem, const StressField& stress,
                      const std::optional<DisplacementField>& u,
                      const std::vector<Eigen::Vector2d>& points_mm) {
  const PointLocator locator(problem, stress.degree());
  const auto list = [](const auto& vector) {
    return Json(std::vector<double>(vector.begin(), vector.end()));
  };
  Json points = Json::array();
  for (const Eigen::Vector2d& x : points_mm) {
    Json& point = points.emplace_back(Json{{"at_mm", list(x)}});
    const auto place = locator.place_of(x);
    point["stress_MPa"] = place ? list(stress_at(locator, stress, x)) : Json();
    if (!u) continue;
    point["displacement_mm"] = Json();
    if (!place) continue;
    Eigen::Vector3d lambda = Eigen::Vector3d::Constant(place->weights(2) / 3);
    lambda(place->third) += place->weights(0);
    lambda((place->third + 1) % 3) += place->weights(1);
    point["displacement_mm"] = list(displacement_at(problem, *u, place->triangle, lambda));
  }
  return points;
}

}  // namespace airybench
