// The formulas of hybrid_element.hpp, for whoever instantiates them for a scalar of their own.
#pragma once

#include "assembly/edge_forces.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {

template <typename Scalar>
Eigen::Matrix4<Scalar> edge_components(const Mesh& mesh, int triangle, int k, bool in_frame) {
  const auto& v = mesh.triangles[triangle];
  const int a = v[k], b = v[(k + 1) % 3];
  Eigen::Matrix4<Scalar> q = Eigen::Matrix4<Scalar>::Zero();
  if (in_frame) {
    const EdgeFrameIn<Scalar> frame = edge_frame<Scalar>(mesh.vertices[a], mesh.vertices[b]);
    q.template block<2, 1>(0, 0) = q.template block<2, 1>(2, 2) = frame.normal;
    q.template block<2, 1>(0, 1) = q.template block<2, 1>(2, 3) = frame.tangent;
  } else if (a < b) {
    q.setIdentity();
  } else {
    q.template topRightCorner<2, 2>().setIdentity();
    q.template bottomLeftCorner<2, 2>().setIdentity();
  }
  return q;
}

template <typename Scalar>
HybridElement<Scalar> make_hybrid_element(const Problem& problem, const std::vector<bool>& in_frame,
                                          int t) {
  const TriangleVertices v = problem.vertices_of(t);
  const EdgeSigns outward = problem.edge_signs(t);
  const auto& compliance = problem.compliance_of(t);
  const Scalar area = problem.area_mm2<Scalar>(t);
  HybridElement<Scalar> element;
  element.stress = hct_stress<Scalar>(v, outward);
  const Eigen::Matrix<Scalar, 27, 9> stress = element.stress.template rightCols<9>();
  element.flexibility = SmallCholesky<Scalar, 9>(hct_flexibility(stress, area, compliance));
  if (!element.flexibility.positive())
    throw Breakdown("hybridized: triangle " + std::to_string(t + 1) +
                    ": its flexibility is not positive definite to rounding");

  element.loaded = problem.loads.has_body_force();
  element.particular.setZero();
  element.particular_load.setZero();
  if (element.loaded) {
    element.particular = particular_element_stress<Scalar>(problem, t);
    const Eigen::Matrix<Scalar, 27, 1> dual =
        stress_dual<Scalar>(element.particular, area, compliance).reshaped();
    for (int i = 0; i < 9; ++i) element.particular_load(i) = element.stress.col(3 + i).dot(dual);
  }

  element.forces.setZero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, edge = problem.edges.of_triangle[t][k];
    const EdgeForcesIn<Scalar> f = edge_forces<Scalar>(v.col(k), v.col(next), outward[k]);
    const Eigen::Matrix4<Scalar> q = edge_components<Scalar>(problem.mesh, t, k, in_frame[edge]);
    const Eigen::Vector4<Scalar> particular =
        element_edge_forces<Scalar>(v, element.particular, k).reshaped();
    const std::array<int, 7> dofs = {3 * k,        3 * k + 1,    3 * k + 2, 3 * next,
                                     3 * next + 1, 3 * next + 2, 9 + k};
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 7; ++j)
        if (dofs[j] >= 3) element.forces(dofs[j] - 3, 4 * k + i) = q.col(i).dot(f.col(j));
      element.particular_forces(4 * k + i) = q.col(i).dot(particular);
    }
  }
  return element;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 12, 12> HybridElement<Scalar>::stiffness() const {
  Eigen::Matrix<Scalar, 9, 12> root = forces;
  flexibility.solve_lower(root);
  Eigen::Matrix<Scalar, 12, 12> K;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i <= j; ++i) K(i, j) = K(j, i) = root.col(i).dot(root.col(j));
  return K;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 12, 1> HybridElement<Scalar>::load() const {
  Eigen::Matrix<Scalar, 12, 1> f = particular_forces;
  if (loaded) {
    Eigen::Matrix<Scalar, 9, 1> phi = particular_load;
    flexibility.solve(phi);
    f -= forces.transpose().lazyProduct(phi);
  }
  return f;
}

template <typename Scalar>
ElementStressIn<Scalar> HybridElement<Scalar>::stress_at(
    const Eigen::Matrix<Scalar, 12, 1>& displacement) const {
  Eigen::Matrix<Scalar, 9, 1> phi = forces.lazyProduct(displacement) - particular_load;
  flexibility.solve(phi);
  ElementStressIn<Scalar> total;
  total.reshaped() = stress.template rightCols<9>().lazyProduct(phi);
  if (loaded) total += particular;
  return total;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 9, 1> HybridElement<Scalar>::incompatibility(
    const Problem& problem, int t, const Eigen::Matrix<Scalar, 12, 1>& displacement,
    const ElementStressIn<Scalar>& total) const {
  const Eigen::Matrix<Scalar, 27, 1> dual =
      stress_dual<Scalar>(total, problem.area_mm2<Scalar>(t), problem.compliance_of(t)).reshaped();
  return forces.lazyProduct(displacement) -
         stress.template rightCols<9>().transpose().lazyProduct(dual);
}

}  // namespace airybench
