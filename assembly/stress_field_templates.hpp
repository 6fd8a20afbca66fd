// Definitions of stress_field.hpp, to instantiate them for further scalars.
#pragma once

#include "assembly/edge_forces.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

template <typename Scalar>
ElementStressIn<Scalar> particular_element_stress(const Problem& problem, int triangle) {
  const Eigen::Matrix<Scalar, 2, 3> v = problem.vertices_of(triangle).cast<Scalar>();
  const Eigen::Vector3<Scalar> centre =
      problem.particular_stress<Scalar>((v.col(0) + v.col(1) + v.col(2)) / Scalar(3));
  ElementStressIn<Scalar> stress;
  for (int t = 0; t < 3; ++t)
    stress.template middleCols<3>(3 * t) << problem.particular_stress<Scalar>(v.col(t)),
        problem.particular_stress<Scalar>(v.col((t + 1) % 3)), centre;
  return stress;
}

template <typename Scalar>
void subtract_affine_part(const TriangleVertices& v, const EdgeSigns& outward,
                          Eigen::Matrix<Scalar, 12, 1>& local) {
  const Eigen::Vector2<Scalar> slope =
      (local.template segment<2>(1) + local.template segment<2>(4) + local.template segment<2>(7)) /
      3;
  const Scalar value = (local(0) + local(3) + local(6)) / 3;
  const Eigen::Matrix<Scalar, 2, 3> corners = v.cast<Scalar>();
  const Eigen::Vector2<Scalar> centroid = corners.rowwise().mean();
  for (int k = 0; k < 3; ++k) {
    local(3 * k) -= value + slope.dot(corners.col(k) - centroid);
    local.template segment<2>(3 * k + 1) -= slope;
    local(9 + k) -= outward[k] * slope.dot(edge_frame<Scalar>(v.col(k), v.col((k + 1) % 3)).normal);
  }
}

template <typename Scalar>
ElementStressIn<Scalar> stress_dual(const Eigen::Matrix<Scalar, 3, 9>& stress,
                                    std::type_identity_t<Scalar> area_mm2,
                                    const Eigen::Matrix3<Data<Scalar>>& compliance) {
  // On a third of area a: ∫ λ_m λ_n = a (1 + δ_mn) / 12.
  const Eigen::Matrix3<Scalar> weight = area_mm2 / Scalar(36) * compliance.template cast<Scalar>();
  ElementStressIn<Scalar> dual;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix3<Scalar> corners = stress.template middleCols<3>(3 * t);
    dual.template middleCols<3>(3 * t) = weight * (corners.colwise() + corners.rowwise().sum());
  }
  return dual;
}

template <typename Scalar>
Eigen::Matrix2<Scalar> element_edge_forces(const TriangleVerticesFor<Scalar>& v,
                                           const Eigen::Matrix<Scalar, 3, 9>& stress, int k) {
  const EdgeFrameIn<Scalar> frame = edge_frame<Scalar>(v.col(k), v.col((k + 1) % 3));
  Eigen::Matrix2<Scalar> forces;
  forces << traction<Scalar>(stress.col(3 * k), frame.normal),
      traction<Scalar>(stress.col(3 * k + 1), frame.normal);
  return frame.length_mm / Scalar(2) * forces;
}

}  // namespace airybench
