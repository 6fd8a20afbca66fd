// Definitions of hct.hpp, to instantiate them for further scalars.
#pragma once

#include <cmath>

#include "assembly/elements/hct.hpp"

namespace airybench {
namespace hct_formulas {

constexpr int next(int i) { return (i + 1) % 3; }

template <typename Scalar>
using Corners = Eigen::Matrix<Scalar, 2, 3>;  // columns V1 V2 V3

// Row of a coefficient: the value at a vertex plus the derivative there along a direction.
template <typename Scalar>
void extrapolate(HctCoefficientsIn<Scalar>& c, int row, int vertex,
                 const Eigen::Vector2<Scalar>& direction) {
  for (int dof = 0; dof < 12; ++dof) c(row, dof) = c(vertex, dof);
  c(row, 3 * vertex + 1) += direction.x();
  c(row, 3 * vertex + 2) += direction.y();
}

// Gradients of the barycentric coordinates of triangle abc (columns), 1/mm.
template <typename Scalar>
Corners<Scalar> barycentric_gradients(const Eigen::Vector2<Scalar>& a,
                                      const Eigen::Vector2<Scalar>& b,
                                      const Eigen::Vector2<Scalar>& c) {
  const auto inward = [](const Eigen::Vector2<Scalar>& edge) {  // turned left
    return Eigen::Vector2<Scalar>(-edge.y(), edge.x());
  };
  const Eigen::Vector2<Scalar> ab = b - a, ac = c - a;
  Corners<Scalar> gradients;
  gradients << inward(c - b), inward(-ac), inward(ab);
  return gradients / (ab.x() * ac.y() - ab.y() * ac.x());
}

// Moves the triangle to the origin; far from it sums of coordinates lose digits.
template <typename Scalar>
Corners<Scalar> at_origin(const TriangleVerticesFor<Scalar>& v) {
  const Corners<Scalar> corners = v.template cast<Scalar>();
  return corners.colwise() - corners.col(0);
}
template <typename Scalar>
Eigen::Vector2<Scalar> mean(const Corners<Scalar>& v) {
  return (v.col(0) + v.col(1) + v.col(2)) / Scalar(3);
}

// α with  α_0 V_i + α_1 V_j + α_2 V_4 = n,  the normal of edge V_i V_j: its derivative at the
// edge's middle is 3/4 Σ_p α_p (c_{200+p} + 2 c_{110+p} + c_{020+p}).
template <typename Scalar>
Eigen::Vector3<Scalar> normal_direction(const Eigen::Vector2<Scalar>& i,
                                        const Eigen::Vector2<Scalar>& j,
                                        const Eigen::Vector2<Scalar>& centroid) {
  using Vector = Eigen::Vector2<Scalar>;
  const Vector edge = j - i;
  const Vector normal = Vector(edge.y(), -edge.x()) / edge.norm();
  return barycentric_gradients<Scalar>(i, j, centroid).transpose() * normal;
}

// Place in hct_third() of the coefficient with exponents e_m + e_p + e_q, for corner m and
//   (p, q) = (0,0) (1,1) (2,2) (0,1) (0,2) (1,2).
constexpr int near_corner[3][6] = {{0, 4, 8, 3, 5, 7}, {3, 1, 9, 4, 7, 6}, {5, 6, 2, 7, 8, 9}};

// Stress at corner m of a third from those six: second derivatives are
//   6 Σ_pq ∇λ_p ∇λ_qᵀ c_{e_m+e_p+e_q}.
// Rows φ,yy  φ,xx  −φ,xy.
template <typename Scalar>
Eigen::Matrix<Scalar, 3, 6> stress_weights(const Corners<Scalar>& gradients) {
  const Corners<Scalar>& g = gradients;
  Eigen::Matrix<Scalar, 3, 6> weights;
  for (int p = 0; p < 3; ++p)
    weights.col(p) << g(1, p) * g(1, p), g(0, p) * g(0, p), -g(0, p) * g(1, p);
  for (int k = 0; k < 3; ++k) {
    const int p = k == 2 ? 1 : 0, q = k == 0 ? 1 : 2;
    weights.col(3 + k) << 2 * g(1, p) * g(1, q), 2 * g(0, p) * g(0, q),
        -g(0, p) * g(1, q) - g(0, q) * g(1, p);
  }
  return weights * Scalar(6);
}

// Rows 12 to 18 from the earlier ones. at(row): a coefficient; normal(t): 4/3 of the outward
// derivative at the middle of edge t.
template <typename Scalar, typename At, typename Normal>
void complete_coefficients(const std::array<Eigen::Vector3<Scalar>, 3>& alpha, At at,
                           Normal normal) {
  const Scalar two = 2, three = 3;
  for (int t = 0; t < 3; ++t) {
    const int i = t, j = next(t), near_i = 3 + 2 * t, near_j = 4 + 2 * t;
    // Solved for c_111, whose factor is α_2.
    Scalar inner = normal(t);
    inner -= alpha[t](0) * (at(i) + two * at(near_i) + at(near_j));
    inner -= alpha[t](1) * (at(near_i) + two * at(near_j) + at(j));
    inner -= alpha[t](2) * (at(9 + i) + at(9 + j));
    at(12 + t) = inner / (two * alpha[t](2));
  }
  for (int i = 0; i < 3; ++i)
    at(15 + i) = (at(9 + i) + at(12 + i) + at(12 + next(next(i)))) / three;
  at(18) = (at(15) + at(16) + at(17)) / three;
}

}  // namespace hct_formulas

template <typename Scalar>
HctCoefficientsIn<Scalar> hct_coefficients(const TriangleVerticesFor<Scalar>& vertices,
                                           const EdgeSigns& outward) {
  using namespace hct_formulas;
  using Vector = Eigen::Vector2<Scalar>;
  const Scalar three = 3;
  const Corners<Scalar> v = at_origin<Scalar>(vertices);
  const Vector centroid = mean(v);
  std::array<Eigen::Vector3<Scalar>, 3> alpha;
  HctCoefficientsIn<Scalar> c = HctCoefficientsIn<Scalar>::Zero();
  for (int i = 0; i < 3; ++i) {
    c(i, 3 * i) = 1;
    extrapolate<Scalar>(c, 9 + i, i, (centroid - v.col(i)) / three);
  }
  for (int t = 0; t < 3; ++t) {
    const int i = t, j = next(t);
    const Vector edge = v.col(j) - v.col(i);
    extrapolate<Scalar>(c, 3 + 2 * t, i, edge / three);
    extrapolate<Scalar>(c, 4 + 2 * t, j, edge / -three);
    alpha[t] = normal_direction<Scalar>(v.col(i), v.col(j), centroid);
  }
  for (int dof = 0; dof < 12; ++dof)
    complete_coefficients<Scalar>(
        alpha, [&](int row) -> Scalar& { return c(row, dof); },
        [&](int t) { return dof == 9 + t ? Scalar(outward[t] * 4) / three : Scalar(0); });
  return c;
}

template <typename Scalar>
HctStressIn<Scalar> hct_stress(const TriangleVerticesFor<Scalar>& vertices,
                               const EdgeSigns& outward) {
  using namespace hct_formulas;
  const Corners<Scalar> v = at_origin<Scalar>(vertices);
  const HctCoefficientsIn<Scalar> c = hct_coefficients<Scalar>(vertices, outward);
  const Eigen::Vector2<Scalar> centroid = mean(v);
  HctStressIn<Scalar> stress;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix<Scalar, 3, 6> weights =
        stress_weights<Scalar>(barycentric_gradients<Scalar>(v.col(t), v.col(next(t)), centroid));
    const std::array<int, 10> third = hct_third(t);
    for (int m = 0; m < 3; ++m) {
      Eigen::Matrix<Scalar, 6, 12> near;
      for (int k = 0; k < 6; ++k) near.row(k) = c.row(third[near_corner[m][k]]);
      stress.template middleRows<3>(3 * (3 * t + m)) = weights.lazyProduct(near);
    }
  }
  return stress;
}

}  // namespace airybench
