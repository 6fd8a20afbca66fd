// The templates of curved_side.hpp and curved_element.hpp, to be instantiated for another scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/curved_element.hpp"
#include "assembly/elements/equilibrium_element.hpp"
#include "support/lagrange.hpp"

namespace airybench {

namespace curved_formulas {

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

// Of curves of so many parts at the q-th of n Gauss points.
template <typename Scalar, int n>
const LagrangeBasis<Scalar>& basis_at(int parts, int q) {
  static const auto bases = [] {
    std::vector<LagrangeBasis<Scalar>> all;
    for (int i = 1; i <= SideCurve::max_parts; ++i)
      for (const Scalar& xi : GaussPoints<Scalar, n>::get().at) all.emplace_back(i, xi);
    return all;
  }();
  return bases.at(static_cast<std::size_t>((parts - 1) * n + q));
}

// The same of a curve itself.
template <typename Scalar, int n>
CurvePoint<Scalar> point_at(const SideCurve& curve, int q) {
  return {curve,
          [q](int parts) -> const LagrangeBasis<Scalar>& { return basis_at<Scalar, n>(parts, q); }};
}

// ρ and weights of 1, 2, ... points.
template <typename Scalar>
struct AcrossRule {
  const Scalar *at, *weight;
};
template <typename Scalar, int max_points>
const AcrossRule<Scalar>& rule_across(int points) {
  static const auto rules = []<int... n>(std::integer_sequence<int, n...>) {
    return std::array<AcrossRule<Scalar>, max_points>{
        AcrossRule<Scalar>{GaussPoints<Scalar, n + 1>::get().at.data(),
                           GaussPoints<Scalar, n + 1>::get().weight.data()}...};
  }
  (std::make_integer_sequence<int, max_points>());
  return rules.at(static_cast<std::size_t>(points - 1));
}

// Columns: the normal and its tangent.
template <typename Scalar>
Eigen::Matrix2<Scalar> frame_from(const Eigen::Vector2<Scalar>& direction) {
  using std::sqrt;
  const Eigen::Vector2<Scalar> n = direction / sqrt(direction.squaredNorm());
  Eigen::Matrix2<Scalar> frame;
  frame << n.x(), -n.y(), n.y(), n.x();
  return frame;
}

}  // namespace curved_formulas

template <typename Scalar>
CurvePoint<Scalar>::CurvePoint(const SideCurve& curve, const Scalar& xi)
    : CurvePoint(curve, [&](int parts) { return LagrangeBasis<Scalar>(parts, xi); }) {}

template <typename Scalar>
template <typename Basis>
CurvePoint<Scalar>::CurvePoint(const SideCurve& curve, const Basis& basis_of)
    : frame(Eigen::Matrix2<Scalar>::Identity()) {
  using Vector = Eigen::Vector2<Scalar>;
  const auto sum = [](std::span<const Eigen::Vector2d> values, const std::vector<Scalar>& weight) {
    Vector result = Vector::Zero();
    for (std::size_t i = 0; i < values.size(); ++i)
      result += weight[i] * values[i].template cast<Scalar>();
    return result;
  };
  const LagrangeBasis<Scalar>& along = basis_of(static_cast<int>(curve.points_mm.size()) - 1);
  at = sum(curve.points_mm, along.value);
  tangent = sum(curve.points_mm, along.derivative);
  if (curve.law_normals.empty()) return;
  const LagrangeBasis<Scalar>& law = basis_of(static_cast<int>(curve.law_normals.size()) - 1);
  frame = curved_formulas::frame_from<Scalar>(sum(curve.law_normals, law.value));
}

template <typename Scalar>
CurvedThird<Scalar>::CurvedThird(const SideCurve& curve, int degree)
    : degree_(degree),
      a_(curve.points_mm.front().cast<Scalar>()),
      b_(curve.points_mm.back().cast<Scalar>()) {
  for (int q = 0; q < points; ++q) {
    const CurvePoint<Scalar> point =
        curved_formulas::point_at<Scalar, points>({curve.points_mm, {}, {}}, q);
    at_[q] = point.at;
    normal_[q] = Vector(point.tangent.y(), -point.tangent.x());
  }
}

template <typename Scalar>
CurvedSide<Scalar>::CurvedSide(const SideCurve& curve, int degree)
    : CurvedThird<Scalar>(curve, degree) {
  const int count = degree + 1;
  const bool has_law = !curve.law_normals.empty();
  std::vector<Eigen::Matrix2<Scalar>> fixed;  // R_jᵀ
  for (const Eigen::Vector2d& n : curve.moment_normals)
    fixed.push_back(curved_formulas::frame_from<Scalar>(n.cast<Scalar>()).transpose());
  Matrix pairing = Matrix::Zero(2 * count, 2 * count);
  for (int q = 0; q < points; ++q) {
    set_test(q);
    Eigen::Matrix2<Scalar> frame = Eigen::Matrix2<Scalar>::Identity();
    if (has_law) frame = curved_formulas::point_at<Scalar, points>(curve, q).frame;
    density_[q].resize(2, 2 * count);
    OfPoint along(2, 2 * count);  // B_j of x and of y
    for (int j = 0; j < count; ++j) {
      const Scalar B = bernstein_polynomial(degree, j, xi(q));
      along.middleCols(2 * j, 2) = B * Eigen::Matrix2<Scalar>::Identity();
      density_[q].middleCols(2 * j, 2) =
          Scalar(count) * B * (has_law ? frame.lazyProduct(fixed[j]).eval() : frame);
    }
    pairing += weight(q) * (has_law ? test_[q] : along).transpose().lazyProduct(density_[q]);
  }
  pairing_.compute(pairing);
  pairing_transposed_ = pairing.transpose();
}

// Columns: B_j(ẑ) and i B_j(ẑ).
template <typename Scalar>
void CurvedSide<Scalar>::set_test(int q) {
  const Vector chord = b_ - a_, from_a = at_[q] - a_;
  const Scalar square = chord.squaredNorm();
  const Vector z(from_a.dot(chord) / square,
                 (chord.x() * from_a.y() - chord.y() * from_a.x()) / square);
  const auto times = [](const Vector& u, const Vector& v) {
    return Vector(u.x() * v.x() - u.y() * v.y(), u.x() * v.y() + u.y() * v.x());
  };
  test_[q].resize(2, 2 * (degree_ + 1));
  for (int j = 0; j <= degree_; ++j) {
    Vector value(Scalar(binomial(degree_, j)), Scalar(0));
    for (int i = 0; i < j; ++i) value = times(value, z);
    for (int i = j; i < degree_; ++i) value = times(value, Vector(1 - z.x(), -z.y()));
    test_[q].col(2 * j) = value;
    test_[q].col(2 * j + 1) = Vector(-value.y(), value.x());
  }
}

template <typename Scalar>
const Scalar& CurvedThird<Scalar>::xi(int q) {
  return curved_formulas::GaussPoints<Scalar, points>::get().at[q];
}

template <typename Scalar>
const Scalar& CurvedThird<Scalar>::weight(int q) {
  return curved_formulas::GaussPoints<Scalar, points>::get().weight[q];
}

template <typename Scalar>
Eigen::VectorX<Scalar> CurvedSide<Scalar>::tested(const Eigen::Matrix2X<Scalar>& field) const {
  Eigen::VectorX<Scalar> sum = Eigen::VectorX<Scalar>::Zero(2 * (degree_ + 1));
  for (int q = 0; q < points; ++q)
    sum += weight(q) * test_[q].transpose().lazyProduct(field.col(q));
  return sum;
}

template <typename Scalar>
Eigen::Matrix2X<Scalar> CurvedSide<Scalar>::forces(const Eigen::Matrix2X<Scalar>& density) const {
  return pairing_.solve(tested(density)).reshaped(2, degree_ + 1);
}

template <typename Scalar>
Eigen::Matrix2X<Scalar> CurvedSide<Scalar>::moments(
    const Eigen::Matrix2X<Scalar>& displacement) const {
  using std::sqrt;
  Matrix rows(2 * points, 2 * (degree_ + 1));
  for (int q = 0; q < points; ++q) rows.middleRows(2 * q, 2) = sqrt(weight(q)) * test_[q];
  Eigen::VectorX<Scalar> best = tested(displacement);
  GramRoot<Scalar>(std::move(rows)).solve(best.data());
  return pairing_transposed_.lazyProduct(best).reshaped(2, degree_ + 1);
}

template <typename Scalar>
typename CurvedSide<Scalar>::Vector CurvedSide<Scalar>::density(
    const Eigen::Matrix2X<Scalar>& forces, int q) const {
  return density_[q].lazyProduct(forces.reshaped());
}

template <typename Scalar>
Eigen::VectorX<Scalar> CurvedThird<Scalar>::bernstein(const Vector& centroid, int q,
                                                      const Scalar& rho) const {
  const auto cross = [](const Vector& u, const Vector& v) { return u.x() * v.y() - u.y() * v.x(); };
  const Scalar whole = cross(b_ - a_, centroid - a_);
  const Scalar first = rho * cross(b_ - at_[q], centroid - at_[q]) / whole,
               second = rho * cross(at_[q] - a_, centroid - a_) / whole, last = 1 - first - second;
  return bernstein_values<Scalar>(degree_, {first, second, last});
}

template <typename Scalar>
typename CurvedSide<Scalar>::Matrix CurvedSide<Scalar>::stress_forces(
    const Vector& centroid) const {
  const int count = bernstein_count(degree_);
  Matrix moments = Matrix::Zero(2 * (degree_ + 1), 3 * count);
  for (int q = 0; q < points; ++q) {
    const Eigen::VectorX<Scalar> value = this->bernstein(centroid, q, Scalar(1));
    const Vector n = weight(q) * normal_[q];
    Eigen::Matrix<Scalar, 2, 3> to_traction;
    to_traction << n.x(), 0, n.y(), 0, n.y(), n.x();
    const Matrix of_one = test_[q].transpose().lazyProduct(to_traction);
    for (int i = 0; i < count; ++i) moments.middleCols(3 * i, 3) += value(i) * of_one;
  }
  return pairing_.solve(moments);
}

template <typename Scalar>
typename CurvedThird<Scalar>::Layer CurvedThird<Scalar>::layer(const Vector& centroid, int q, int l,
                                                               int layers) const {
  const auto& across = curved_formulas::rule_across<Scalar, max_layers>(layers);
  const Scalar& rho = across.at[l];
  return {rho, rho * across.weight[l] * weight(q) * (at_[q] - centroid).dot(normal_[q])};
}

template <typename Scalar>
typename CurvedThird<Scalar>::Matrix CurvedThird<Scalar>::mass_root(const Vector& centroid) const {
  using std::sqrt;
  const int layers = degree_ + 1;
  Matrix rows(points * layers, bernstein_count(degree_));
  for (int q = 0; q < points; ++q)
    for (int l = 0; l < layers; ++l) {
      const auto [rho, area] = layer(centroid, q, l, layers);
      rows.row(q * layers + l) = sqrt(area) * bernstein(centroid, q, rho).transpose();
    }
  return GramRoot<Scalar>(std::move(rows)).R();
}

template <typename Scalar>
CurvedElement<Scalar>::CurvedElement(const TriangleVertices& vertices,
                                     const Eigen::Matrix3d& compliance, const CurvedSides& sides,
                                     int degree)
    : third_(bernstein_count(degree)) {
  using Point = Eigen::Vector2<Scalar>;
  const int points = degree + 1;
  const Eigen::Matrix<Scalar, 2, 3> v = vertices.cast<Scalar>();
  const Point centroid = (v.col(0) + v.col(1) + v.col(2)) / Scalar(3);
  const ReferenceMatrices<Scalar>& reference = reference_matrices<Scalar>(degree);
  Eigen::Matrix2<Scalar> B;
  B << v.col(1) - v.col(0), v.col(2) - v.col(0);
  const Scalar determinant = B(0, 0) * B(1, 1) - B(0, 1) * B(1, 0);
  using std::sqrt;
  for (int t = 0; t < 3; ++t) {
    if (!sides[t].is_straight()) {
      const CurvedSide<Scalar> side(sides[t], degree);
      forces_[t] = side.stress_forces(centroid);
      mass_root_[t] = side.mass_root(centroid);
      continue;
    }
    mass_root_[t] =
        sqrt(determinant) * Eigen::Map<const Matrix>(reference.mass_root, third_, third_);
    const Point edge = (v.col((t + 1) % 3) - v.col(t)) / Scalar(points);
    forces_[t] = Matrix::Zero(2 * points, 3 * third_);
    for (int j = 0; j < points; ++j)  // from xx, yy, xy, with n = (y, −x)
      forces_[t].template block<2, 3>(2 * j, 3 * j) << edge.y(), 0, -edge.x(), 0, -edge.x(),
          edge.y();
  }
  compliance_root_ = SmallCholesky<Scalar, 3>(compliance.cast<Scalar>()).L().transpose();

  const Eigen::Matrix3<Scalar> to_stress = equilibrium_formulas::stress_map(B, determinant);
  const Eigen::Index coefficients = 3 * third_,
                     modes = with_degree(degree, [](auto k) { return StressDegree<k>::modes; });
  modes_.resize(3 * coefficients, modes);
  of_modes_.resize(3 * coefficients, modes);
  forces_of_modes_.resize(6 * points, modes);
  for (Eigen::Index mode = 0; mode < modes; ++mode) {
    Stress tau(3, coefficients);
    for (int x = 0; x < 3; ++x)
      tau.row(x) = Eigen::Map<const Vector>(reference.stress[x] + coefficients * mode, coefficients)
                       .transpose();
    const Stress stress = to_stress.lazyProduct(tau);
    modes_.col(mode) = stress.reshaped();
    of_modes_.col(mode) = weighted(stress);
    forces_of_modes_.col(mode) = edge_forces(stress);
  }
  root_ = GramRoot<Scalar>(of_modes_);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Vector CurvedElement<Scalar>::weighted(const Stress& stress) const {
  Stress result(3, stress.cols());
  for (int t = 0; t < 3; ++t)
    result.middleCols(third_ * t, third_) =
        compliance_root_.lazyProduct(stress.middleCols(third_ * t, third_))
            .eval()
            .lazyProduct(mass_root_[t].transpose());
  return result.reshaped();
}

template <typename Scalar>
typename CurvedElement<Scalar>::OnEdges CurvedElement<Scalar>::edge_forces(
    const Stress& stress) const {
  const Eigen::Index per_edge = forces_[0].rows();
  OnEdges forces(3 * per_edge);
  for (int t = 0; t < 3; ++t)
    forces.segment(per_edge * t, per_edge) =
        forces_[t].lazyProduct(stress.middleCols(third_ * t, third_).reshaped());
  return forces;
}

// R⁻ᵀ Tᵀ, of all modes.
template <typename Scalar>
typename CurvedElement<Scalar>::Root CurvedElement<Scalar>::root() const {
  Matrix root = forces_of_modes_.transpose();
  for (Eigen::Index j = 0; j < root.cols(); ++j) root_.solve_lower(&root(0, j));
  return root;
}

template <typename Scalar>
void CurvedElement<Scalar>::square(const Root& R, Scalar* lower) {
  for (Eigen::Index j = 0; j < R.cols(); ++j)
    for (Eigen::Index i = j; i < R.cols(); ++i) *lower++ = R.col(i).dot(R.col(j));
}

template <typename Scalar>
void CurvedElement<Scalar>::subtract_outer_load(const Root& R, const Stress& particular,
                                                Scalar* forces) const {
  Vector y = of_modes_.transpose().lazyProduct(weighted(particular));
  root_.solve_lower(y.data());
  Eigen::Map<Vector>(forces, R.cols()) -= R.transpose().lazyProduct(y);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Vector CurvedElement<Scalar>::excess_work(
    const OnEdges& displacement, const Stress& stress) const {
  return forces_of_modes_.transpose().lazyProduct(displacement) -
         of_modes_.transpose().lazyProduct(weighted(stress));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::of_modes(Vector work) const {
  root_.solve(work.data());
  return modes_.lazyProduct(work).reshaped(3, 3 * third_);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::stress(
    const OnEdges& displacement) const {
  return of_modes(forces_of_modes_.transpose().lazyProduct(displacement));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::stress(
    const OnEdges& displacement, const Stress& particular) const {
  return particular + of_modes(excess_work(displacement, particular));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Defect CurvedElement<Scalar>::defect(const OnEdges& displacement,
                                                                     const Stress& total) const {
  const Vector g = excess_work(displacement, total);
  Vector correction = g;
  root_.solve(correction.data());
  return {edge_forces(of_modes(g)), g.dot(correction)};
}

template <typename Scalar>
Scalar CurvedElement<Scalar>::energy(const Stress& sigma, const Stress& tau) const {
  return weighted(sigma).dot(weighted(tau));
}

}  // namespace airybench
