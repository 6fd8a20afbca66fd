#include "assembly/hct.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "assembly/mesh.hpp"

namespace airybench {
namespace {

constexpr int next(int i) { return (i + 1) % 3; }

Eigen::Matrix<double, 1, 12> directional_derivative(int vertex, const Eigen::Vector2d& direction) {
  Eigen::Matrix<double, 1, 12> row = Eigen::Matrix<double, 1, 12>::Zero();
  row(3 * vertex + 1) = direction.x();
  row(3 * vertex + 2) = direction.y();
  return row;
}

// Gradients of the barycentric coordinates of triangle abc (columns), 1/mm.
Eigen::Matrix<double, 2, 3> barycentric_gradients(const Eigen::Vector2d& a,
                                                  const Eigen::Vector2d& b,
                                                  const Eigen::Vector2d& c) {
  const auto inward = [](const Eigen::Vector2d& edge) {  // turned left
    return Eigen::Vector2d(-edge.y(), edge.x());
  };
  Eigen::Matrix<double, 2, 3> gradients;
  gradients << inward(c - b), inward(a - c), inward(b - a);
  return gradients / cross_area(a, b, c);
}

// The triangle moved to the origin: far from it, sums of coordinates would lose digits.
TriangleVertices at_origin(const TriangleVertices& v) { return v.colwise() - v.col(0); }

}  // namespace

HctCoefficients hct_coefficients(const TriangleVertices& vertices, const EdgeSigns& outward) {
  const TriangleVertices v = at_origin(vertices);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  HctCoefficients c = HctCoefficients::Zero();
  for (int i = 0; i < 3; ++i) {
    c(i, 3 * i) = 1;
    c.row(9 + i) = c.row(i) + directional_derivative(i, (centroid - v.col(i)) / 3);
  }
  for (int t = 0; t < 3; ++t) {
    const int i = t, j = next(t);
    const Eigen::Vector2d edge = v.col(j) - v.col(i);
    c.row(3 + 2 * t) = c.row(i) + directional_derivative(i, edge / 3);
    c.row(4 + 2 * t) = c.row(j) - directional_derivative(j, edge / 3);

    // The derivative along α_i V_i + α_j V_j + α_4 V_4 = n at the edge's middle is
    // 3/4 Σ_p α_p (c_{200+p} + 2 c_{110+p} + c_{020+p}); solve for c_111, which comes with α_4.
    const Eigen::Vector2d normal = Eigen::Vector2d(edge.y(), -edge.x()) / edge.norm();
    const Eigen::Vector3d alpha =
        barycentric_gradients(v.col(i), v.col(j), centroid).transpose() * normal;
    auto inner = c.row(12 + t);
    inner(9 + t) = outward[t] * 4 / 3;
    inner -= alpha(0) * (c.row(i) + 2 * c.row(3 + 2 * t) + c.row(4 + 2 * t));
    inner -= alpha(1) * (c.row(3 + 2 * t) + 2 * c.row(4 + 2 * t) + c.row(j));
    inner -= alpha(2) * (c.row(9 + i) + c.row(9 + j));
    inner /= 2 * alpha(2);
  }
  for (int i = 0; i < 3; ++i)
    c.row(15 + i) = (c.row(9 + i) + c.row(12 + i) + c.row(12 + next(next(i)))) / 3;
  c.row(18) = (c.row(15) + c.row(16) + c.row(17)) / 3;
  return c;
}

std::array<int, 10> hct_third(int t) {
  const int i = t, j = next(t);
  return {i, j, 18, 3 + 2 * t, 4 + 2 * t, 9 + i, 9 + j, 12 + t, 15 + i, 15 + j};
}

HctStress hct_stress(const TriangleVertices& vertices, const EdgeSigns& outward) {
  const TriangleVertices v = at_origin(vertices);
  // Where hct_third() keeps the coefficient with exponents e_m + e_p + e_q, for corner m and
  // (p, q) = (0,0) (1,1) (2,2) (0,1) (0,2) (1,2).
  constexpr int at[3][6] = {{0, 4, 8, 3, 5, 7}, {3, 1, 9, 4, 7, 6}, {5, 6, 2, 7, 8, 9}};
  const HctCoefficients c = hct_coefficients(v, outward);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  HctStress stress;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix<double, 2, 3> g = barycentric_gradients(v.col(t), v.col(next(t)), centroid);
    // Second derivatives at corner m: 6 Σ_pq ∇λ_p ∇λ_qᵀ c_{e_m+e_p+e_q}.
    Eigen::Matrix<double, 3, 6> weights;  // rows φ,yy  φ,xx  −φ,xy
    for (int p = 0; p < 3; ++p)
      weights.col(p) << g(1, p) * g(1, p), g(0, p) * g(0, p), -g(0, p) * g(1, p);
    for (int k = 0; k < 3; ++k) {
      const int p = k == 2 ? 1 : 0, q = k == 0 ? 1 : 2;
      weights.col(3 + k) << 2 * g(1, p) * g(1, q), 2 * g(0, p) * g(0, q),
          -g(0, p) * g(1, q) - g(0, q) * g(1, p);
    }
    weights *= 6;
    const std::array<int, 10> third = hct_third(t);
    for (int m = 0; m < 3; ++m) {
      Eigen::Matrix<double, 6, 12> near;
      for (int k = 0; k < 6; ++k) near.row(k) = c.row(third[at[m][k]]);
      stress.middleRows<3>(3 * (3 * t + m)) = weights.lazyProduct(near);
    }
  }
  return stress;
}

HctFlexibility hct_flexibility(const HctStress& stress, double area_mm2,
                               const Eigen::Matrix3d& compliance) {
  // With compliance = RᵀR the flexibility is MᵀM, where M stacks √(a/12) R σ for the sum and the
  // three corner values of every third.
  const Eigen::Matrix3d root = compliance.llt().matrixU();
  const Eigen::Matrix3d weight = root * std::sqrt(area_mm2 / 36);
  Eigen::Matrix<double, 36, 12> m;
  for (int t = 0; t < 3; ++t) {
    for (int corner = 0; corner < 3; ++corner)
      m.middleRows<3>(12 * t + 3 * corner) =
          weight.lazyProduct(stress.middleRows<3>(9 * t + 3 * corner));
    m.middleRows<3>(12 * t + 9) =
        m.middleRows<3>(12 * t) + m.middleRows<3>(12 * t + 3) + m.middleRows<3>(12 * t + 6);
  }
  HctFlexibility flexibility;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i <= j; ++i) flexibility(i, j) = flexibility(j, i) = m.col(i).dot(m.col(j));
  return flexibility;
}

}  // namespace airybench
