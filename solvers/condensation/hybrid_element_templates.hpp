// The formulas of hybrid_element.hpp, for whoever instantiates them for a scalar of their own.
#pragma once

#include "assembly/edge_forces.hpp"
#include "solvers/condensation/hybrid_element.hpp"
#include "solvers/solution.hpp"

namespace airybench {

template <typename Scalar>
Eigen::Matrix4<Scalar> edge_components(const Mesh& mesh, int triangle, int k, bool is_contact) {
  const auto& v = mesh.triangles[triangle];
  const int a = v[k], b = v[(k + 1) % 3];
  Eigen::Matrix4<Scalar> q = Eigen::Matrix4<Scalar>::Zero();
  if (is_contact) {
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
HybridElement<Scalar> make_hybrid_element(const Problem& problem,
                                          const std::vector<bool>& is_contact_edge, int t) {
  const TriangleVertices v = problem.vertices_of(t);
  const EdgeSigns outward = problem.edge_signs(t);
  const auto& compliance = problem.compliance_of(t);
  const Scalar area = problem.area_mm2<Scalar>(t);
  HybridElement<Scalar> element;
  element.stress = hct_stress<Scalar>(v, outward);
  const HctFlexibilityIn<Scalar> flexibility =
      hct_flexibility<Scalar>(element.stress, area, compliance);
  element.flexibility.compute(flexibility.template bottomRightCorner<9, 9>());
  if (element.flexibility.info() != Eigen::Success)
    throw Breakdown("hybridized: triangle " + std::to_string(t + 1) +
                    ": its flexibility is not positive definite to rounding");

  element.loaded = problem.loads.has_body_force();
  element.particular.setZero();
  element.particular_load.setZero();
  if (element.loaded) {
    element.particular = particular_element_stress<Scalar>(problem, t);
    const Eigen::Matrix<Scalar, 27, 1> dual =
        stress_dual<Scalar>(element.particular, area, compliance).reshaped();
    element.particular_load = (element.stress.transpose() * dual).template tail<9>();
  }

  Eigen::Matrix<Scalar, 12, 12> T = Eigen::Matrix<Scalar, 12, 12>::Zero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, edge = problem.edges.of_triangle[t][k];
    const EdgeForcesIn<Scalar> f = edge_forces<Scalar>(v.col(k), v.col(next), outward[k]);
    const Eigen::Matrix4<Scalar> q =
        edge_components<Scalar>(problem.mesh, t, k, is_contact_edge[edge]);
    Eigen::Matrix<Scalar, 4, 12> rows = Eigen::Matrix<Scalar, 4, 12>::Zero();
    rows.template middleCols<3>(3 * k) = f.template leftCols<3>();
    rows.template middleCols<3>(3 * next) = f.template middleCols<3>(3);
    rows.col(9 + k) = f.col(6);
    T.template middleRows<4>(4 * k) = q.transpose() * rows;
    const Eigen::Vector4<Scalar> particular =
        element_edge_forces<Scalar>(v, element.particular, k).reshaped();
    element.particular_forces.template segment<4>(4 * k) = q.transpose() * particular;
  }
  element.forces = T.template rightCols<9>().transpose();
  return element;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 12, 12> HybridElement<Scalar>::stiffness() const {
  const Eigen::Matrix<Scalar, 9, 12> root = flexibility.matrixL().solve(forces);
  return root.transpose() * root;
}

template <typename Scalar>
Eigen::Matrix<Scalar, 12, 1> HybridElement<Scalar>::load() const {
  Eigen::Matrix<Scalar, 12, 1> f = particular_forces;
  if (loaded) {
    const Eigen::Matrix<Scalar, 9, 1> phi = flexibility.solve(particular_load);
    f -= forces.transpose() * phi;
  }
  return f;
}

template <typename Scalar>
ElementStressIn<Scalar> HybridElement<Scalar>::stress_at(
    const Eigen::Matrix<Scalar, 12, 1>& displacement) const {
  const Eigen::Matrix<Scalar, 9, 1> right_side = forces * displacement - particular_load;
  const Eigen::Matrix<Scalar, 9, 1> phi = flexibility.solve(right_side);
  ElementStressIn<Scalar> total;
  total.reshaped() = stress.template rightCols<9>() * phi;
  if (loaded) total += particular;
  return total;
}

}  // namespace airybench
