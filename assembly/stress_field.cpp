#include "assembly/stress_field.hpp"

#include <cmath>

#include "assembly/edge_forces.hpp"
#include "assembly/quad.hpp"

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

StressField stress_of_airy_function(const Problem& problem, const Eigen::VectorXd& phi) {
  const auto vertices = static_cast<Eigen::Index>(problem.mesh.vertices.size());
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const auto& corner = problem.mesh.triangles[t];
    Eigen::Matrix<double, 12, 1> local;
    for (int k = 0; k < 3; ++k) {
      local.segment<3>(3 * k) = phi.segment<3>(3 * corner[k]);
      local(9 + k) = phi(3 * vertices + problem.edges.of_triangle[t][k]);
    }
    const EdgeSigns outward = problem.edge_signs(t);
    subtract_affine_part(v, outward, local);
    const HctStress from_dofs = hct_stress(v, outward);
    field[t].reshaped() = from_dofs * local;
    if (problem.loads.has_body_force()) field[t] += particular_element_stress(problem, t);
  }
  return field;
}

template <typename Scalar>
ElementStressIn<Scalar> stress_dual(const Eigen::Matrix<Scalar, 3, 9>& stress,
                                    std::type_identity_t<Scalar> area_mm2,
                                    const Eigen::Matrix3d& compliance) {
  // On a third of area a: ∫ λ_m λ_n = a (1 + δ_mn) / 12.
  const Eigen::Matrix3<Scalar> weight = area_mm2 / Scalar(36) * compliance.cast<Scalar>();
  ElementStressIn<Scalar> dual;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix3<Scalar> corners = stress.template middleCols<3>(3 * t);
    dual.template middleCols<3>(3 * t) = weight * (corners.colwise() + corners.rowwise().sum());
  }
  return dual;
}

double stress_norm_squared(const Problem& problem, const StressField& stress) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    sum += stress[t]
               .cwiseProduct(stress_dual(stress[t], problem.area_mm2(t), problem.compliance_of(t)))
               .sum();
  return sum;
}

double stress_distance(const Problem& problem, const StressField& stress,
                       const StressField& other) {
  StressField difference(stress.size());
  for (std::size_t t = 0; t < stress.size(); ++t) difference[t] = stress[t] - other[t];
  return std::sqrt(stress_norm_squared(problem, difference));
}

template <typename Scalar>
Eigen::Matrix2<Scalar> element_edge_forces(const TriangleVertices& v,
                                           const Eigen::Matrix<Scalar, 3, 9>& stress, int k) {
  const EdgeFrameIn<Scalar> frame = edge_frame<Scalar>(v.col(k), v.col((k + 1) % 3));
  Eigen::Matrix2<Scalar> forces;
  forces << traction<Scalar>(stress.col(3 * k), frame.normal),
      traction<Scalar>(stress.col(3 * k + 1), frame.normal);
  return frame.length_mm / Scalar(2) * forces;
}

template ElementStressIn<double> particular_element_stress(const Problem&, int);
template ElementStressIn<double> stress_dual(const ElementStressIn<double>&, double,
                                             const Eigen::Matrix3d&);
template Eigen::Matrix2<double> element_edge_forces(const TriangleVertices&,
                                                    const ElementStressIn<double>&, int);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<double, 12, 1>&);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<long double, 12, 1>&);
template ElementStressIn<long double> particular_element_stress(const Problem&, int);
template ElementStressIn<long double> stress_dual(const ElementStressIn<long double>&, long double,
                                                  const Eigen::Matrix3d&);
template Eigen::Matrix2<long double> element_edge_forces(const TriangleVertices&,
                                                         const ElementStressIn<long double>&, int);
template ElementStressIn<Quad> particular_element_stress(const Problem&, int);
template ElementStressIn<Quad> stress_dual(const ElementStressIn<Quad>&, Quad,
                                           const Eigen::Matrix3d&);
template Eigen::Matrix2<Quad> element_edge_forces(const TriangleVertices&,
                                                  const ElementStressIn<Quad>&, int);

}  // namespace airybench
