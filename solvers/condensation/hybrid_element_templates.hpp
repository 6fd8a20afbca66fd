// The templates of hybrid_element.hpp, to be instantiated for another scalar.
#pragma once

#include <algorithm>

#include "assembly/edge_forces_templates.hpp"
#include "assembly/hct_templates.hpp"
#include "assembly/stress_field_templates.hpp"
#include "solvers/condensation/edge_unknowns.hpp"
#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {

template <typename Scalar, int k>
HybridInput<Scalar, k> hybrid_input(const Problem& problem, const std::vector<int>& rows, int t) {
  HybridInput<Scalar, k> input;
  const TriangleVertices v = problem.vertices_of(t);
  std::copy_n(v.data(), 6, input.vertices);
  std::copy_n(problem.compliance_of(t).data(), 9, input.compliance);
  const auto& corner = problem.mesh.triangles[t];
  for (int e = 0; e < 3; ++e) {
    const int row = rows[problem.edges.of_triangle[t][e]];
    input.from_start[e] = row != no_frame || corner[e] < corner[(e + 1) % 3];
    for (int j = 0; j <= k; ++j) {
      Eigen::Map<Eigen::Matrix2<Scalar>> directions(input.components[e][j]);
      directions.setIdentity();
      if (row == no_frame) continue;
      const EdgeFrameIn<Scalar> frame = problem.frame_of_moment<Scalar>(row, k, j);
      directions << frame.normal, frame.tangent;
    }
    Eigen::Map<Eigen::Vector3<Scalar>> particular(input.particular + 3 * e);
    particular.setZero();
    if (problem.loads.has_body_force())
      particular = problem.particular_stress<Scalar>(v.col(e).template cast<Scalar>());
  }
  return input;
}

// How the components of EdgeUnknowns make an element's edge components: x, y at the start and at
// the end of its walk along an edge.
template <typename Scalar>
Eigen::Matrix4<Scalar> edge_components(const HybridInput<Scalar>& input, int edge) {
  const Scalar along = input.from_start[edge], against = Scalar(1) - along;
  Eigen::Matrix4<Scalar> q;
  for (int end = 0; end < 2; ++end) {
    const Eigen::Map<const Eigen::Matrix2<Scalar>> own(input.components[edge][end]);
    q.template block<2, 2>(2 * end, 2 * end) = along * own;
    q.template block<2, 2>(2 * (1 - end), 2 * end) = against * own;
  }
  return q;
}

template <typename Scalar>
HybridElement<Scalar> make_hybrid_element(const HybridInput<Scalar>& input, bool loaded) {
  const Eigen::Map<const TriangleVerticesFor<Scalar>> v(input.vertices);
  const EdgeSignsFor<Scalar> outward = {1, 1, 1};  // K_e and stresses are the same for all signs
  const Eigen::Matrix3<Data<Scalar>> compliance =
      Eigen::Map<const Eigen::Matrix3<Data<Scalar>>>(input.compliance);
  HybridElement<Scalar> element;
  const hct_formulas::Corners<Scalar> c = hct_formulas::at_origin<Scalar>(v);
  element.area = (c(0, 1) * c(1, 2) - c(1, 1) * c(0, 2)) / Scalar(2);
  element.stress = hct_stress<Scalar, 9>(v, outward);
  element.flexibility = SmallCholesky<Scalar, 9>::of_root(
      hct_flexibility_root(element.stress, element.area, compliance));

  element.loaded = loaded;
  element.particular.setZero();
  element.particular_load.setZero();
  if (loaded) {
    element.particular = linear_stress<1>(
        Eigen::Matrix3<Scalar>(Eigen::Map<const Eigen::Matrix3<Scalar>>(input.particular)));
    const Eigen::Matrix<Scalar, 27, 1> dual =
        stress_dual<Scalar>(element.particular, element.area, compliance).reshaped();
    element.particular_load = element.stress.transpose().lazyProduct(dual);
  }

  element.forces.setZero();
  element.particular_forces.setZero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const EdgeForcesIn<Scalar> f = edge_forces<Scalar>(v.col(k), v.col(next), outward[k]);
    const Eigen::Matrix4<Scalar> q = edge_components(input, k);
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
      stress_dual<Scalar>(total, element.area, compliance).reshaped();
  const Eigen::Matrix<Scalar, 9, 1> g = right - element.stress.transpose().lazyProduct(dual);
  Eigen::Matrix<Scalar, 9, 1> correction = g;
  element.flexibility.solve(correction);
  result.defect_energy = g.dot(correction);
  Eigen::Map<Eigen::Matrix<Scalar, 12, 1>>(result.defect) =
      element.forces.transpose().lazyProduct(correction);

  for (int k = 0; k < 3; ++k)
    Eigen::Map<Eigen::Vector4<Scalar>>(result.forces + 4 * k) =
        edge_components(input, k).transpose().lazyProduct(
            element_edge_forces<Scalar>(v, total, k).reshaped());
  return result;
}

}  // namespace airybench
