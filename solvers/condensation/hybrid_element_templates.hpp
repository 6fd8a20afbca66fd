// The templates of hybrid_element.hpp, to be instantiated for another scalar.
#pragma once

#include <algorithm>

#include "assembly/edge_forces_templates.hpp"
#include "assembly/hct_templates.hpp"
#include "assembly/stress_field_templates.hpp"
#include "solvers/condensation/edge_unknowns.hpp"
#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {

// How the components of EdgeUnknowns make an element's edge components: x, y at the start and at
// the end of its walk along edge k, which is the boundary's. row: rows_in_frame.
template <typename Scalar>
Eigen::Matrix4<Scalar> edge_components(const Problem& problem, int triangle, int k, int row) {
  const auto& v = problem.mesh.triangles[triangle];
  const int a = v[k], b = v[(k + 1) % 3];
  Eigen::Matrix4<Scalar> q = Eigen::Matrix4<Scalar>::Zero();
  if (row != no_frame) {
    for (int end = 0; end < 2; ++end) {
      const EdgeFrameIn<Scalar> frame = problem.frame_of_moment<Scalar>(row, 1, end);
      q.template block<2, 1>(2 * end, 2 * end) = frame.normal;
      q.template block<2, 1>(2 * end, 2 * end + 1) = frame.tangent;
    }
  } else if (a < b) {
    q.setIdentity();
  } else {
    q.template topRightCorner<2, 2>().setIdentity();
    q.template bottomLeftCorner<2, 2>().setIdentity();
  }
  return q;
}

template <typename Scalar>
HybridInput<Scalar> hybrid_input(const Problem& problem, const std::vector<int>& rows, int t) {
  HybridInput<Scalar> input;
  const TriangleVertices v = problem.vertices_of(t);
  const Eigen::Matrix3d& compliance = problem.compliance_of(t);
  std::copy_n(v.data(), 6, input.vertices);
  std::copy_n(problem.edge_signs(t).data(), 3, input.outward);
  std::copy_n(compliance.data(), 9, input.compliance);
  input.area = problem.area_mm2<Scalar>(t);
  for (int k = 0; k < 3; ++k) {
    const int edge = problem.edges.of_triangle[t][k];
    const auto q = edge_components<Scalar>(problem, t, k, rows[edge]);
    std::copy_n(q.data(), 16, input.components[k]);
  }
  if (problem.loads.has_body_force())
    std::copy_n(particular_element_stress<Scalar>(problem, t).data(), 27, input.particular);
  else
    std::fill_n(input.particular, 27, Scalar(0));
  return input;
}

template <typename Scalar>
HybridElement<Scalar> make_hybrid_element(const HybridInput<Scalar>& input, bool loaded) {
  const Eigen::Map<const TriangleVerticesFor<Scalar>> v(input.vertices);
  const EdgeSignsFor<Scalar> outward = {input.outward[0], input.outward[1], input.outward[2]};
  const Eigen::Matrix3<Data<Scalar>> compliance =
      Eigen::Map<const Eigen::Matrix3<Data<Scalar>>>(input.compliance);
  HybridElement<Scalar> element;
  element.stress = hct_stress<Scalar, 9>(v, outward);
  element.flexibility = SmallCholesky<Scalar, 9>::of_root(
      hct_flexibility_root(element.stress, input.area, compliance));

  element.loaded = loaded;
  element.particular = Eigen::Map<const ElementStressIn<Scalar>>(input.particular);
  element.particular_load.setZero();
  if (loaded) {
    const Eigen::Matrix<Scalar, 27, 1> dual =
        stress_dual<Scalar>(element.particular, input.area, compliance).reshaped();
    element.particular_load = element.stress.transpose().lazyProduct(dual);
  }

  element.forces.setZero();
  element.particular_forces.setZero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const EdgeForcesIn<Scalar> f = edge_forces<Scalar>(v.col(k), v.col(next), outward[k]);
    const Eigen::Matrix4<Scalar> q = Eigen::Map<const Eigen::Matrix4<Scalar>>(input.components[k]);
    const std::array<int, 7> dofs = {3 * k,        3 * k + 1,    3 * k + 2, 3 * next,
                                     3 * next + 1, 3 * next + 2, 9 + k};
    for (int j = 0; j < 7; ++j)
      if (dofs[j] >= 3)
        element.forces.template block<1, 4>(dofs[j] - 3, 4 * k) = f.col(j).transpose() * q;
    if (loaded)
      element.particular_forces.template segment<4>(4 * k) =
          q.transpose() * element_edge_forces<Scalar>(v, element.particular, k).reshaped();
  }
  return element;
}

template <typename Scalar>
HybridStiffness<Scalar> hybrid_stiffness(const HybridInput<Scalar>& input, bool loaded) {
  const HybridElement<Scalar> element = make_hybrid_element(input, loaded);
  HybridStiffness<Scalar> result;
  Eigen::Matrix<Scalar, 9, 12> root = element.forces;
  element.flexibility.solve_lower(root);
  Scalar* entry = result.lower;
  for (int j = 0; j < 12; ++j)
    for (int i = j; i < 12; ++i) *entry++ = root.col(i).dot(root.col(j));
  Eigen::Map<Eigen::Matrix<Scalar, 12, 1>> f(result.load);
  f = element.particular_forces;
  if (loaded) {
    Eigen::Matrix<Scalar, 9, 1> phi = element.particular_load;
    element.flexibility.solve_lower(phi);
    f -= root.transpose().lazyProduct(phi);
  }
  result.independence = element.flexibility.independence();
  return result;
}

template <typename Scalar>
HybridStress<Scalar> hybrid_stress(const HybridInput<Scalar>& input, bool loaded,
                                   const Eigen::Matrix<Scalar, 12, 1>& displacement) {
  const HybridElement<Scalar> element = make_hybrid_element(input, loaded);
  const Eigen::Map<const TriangleVerticesFor<Scalar>> v(input.vertices);
  const Eigen::Map<const Eigen::Matrix3<Data<Scalar>>> compliance(input.compliance);
  const Eigen::Matrix<Scalar, 9, 1> right = element.forces.lazyProduct(displacement);
  HybridStress<Scalar> result;

  Eigen::Matrix<Scalar, 9, 1> phi = right - element.particular_load;
  element.flexibility.solve(phi);
  ElementStressIn<Scalar> total = element.particular;
  total.reshaped() += element.stress.lazyProduct(phi);
  Eigen::Map<ElementStressIn<Scalar>>(result.stress) = total;

  const Eigen::Matrix<Scalar, 27, 1> dual =
      stress_dual<Scalar>(total, input.area, compliance).reshaped();
  const Eigen::Matrix<Scalar, 9, 1> g = right - element.stress.transpose().lazyProduct(dual);
  Eigen::Matrix<Scalar, 9, 1> correction = g;
  element.flexibility.solve(correction);
  result.defect_energy = g.dot(correction);
  Eigen::Map<Eigen::Matrix<Scalar, 12, 1>>(result.defect) =
      element.forces.transpose().lazyProduct(correction);

  for (int k = 0; k < 3; ++k)
    Eigen::Map<Eigen::Vector4<Scalar>>(result.forces + 4 * k) =
        Eigen::Map<const Eigen::Matrix4<Scalar>>(input.components[k])
            .transpose()
            .lazyProduct(element_edge_forces<Scalar>(v, total, k).reshaped());
  return result;
}

}  // namespace airybench
