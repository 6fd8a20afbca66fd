// The templates of hybrid_element.hpp, to be instantiated for another scalar.
#pragma once

#include <algorithm>

#include "assembly/elements/equilibrium_element.hpp"
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

// Takes pairs of numbers, per edge and moment, from the order of the element's walk to that of the
// unknowns or back: it is its own inverse.
template <typename Scalar, int k>
void reorder(const HybridInput<Scalar, k>& input, Scalar* pairs) {
  for (int e = 0; e < 3; ++e, pairs += 2 * (k + 1))
    for (int j = 0; j < (k + 1) / 2; ++j)
      for (int x = 0; x < 2; ++x) {
        Scalar &low = pairs[2 * j + x], &high = pairs[2 * (k - j) + x];
        const Scalar along = input.from_start[e], against = Scalar(1) - along;
        const Scalar first = along * low + against * high;
        high = along * high + against * low;
        low = first;
      }
}

// From x and y of the element's walk to the unknowns' components, and back.
template <typename Scalar, int k>
void to_unknowns(const HybridInput<Scalar, k>& input, Scalar* pairs) {
  reorder(input, pairs);
  const Scalar* q = &input.components[0][0][0];
  for (int p = 0; p < 3 * (k + 1); ++p, pairs += 2, q += 4) {
    const Scalar x = pairs[0], y = pairs[1];
    pairs[0] = q[0] * x + q[1] * y;
    pairs[1] = q[2] * x + q[3] * y;
  }
}
template <typename Scalar, int k>
void to_walk(const HybridInput<Scalar, k>& input, Scalar* pairs) {
  const Scalar* q = &input.components[0][0][0];
  for (int p = 0; p < 3 * (k + 1); ++p, q += 4) {
    const Scalar first = pairs[2 * p], second = pairs[2 * p + 1];
    pairs[2 * p] = q[0] * first + q[2] * second;
    pairs[2 * p + 1] = q[1] * first + q[3] * second;
  }
  reorder(input, pairs);
}

template <typename Scalar, int k>
EquilibriumElement<Scalar, k> element_of(const HybridInput<Scalar, k>& input) {
  const Eigen::Map<const TriangleVerticesFor<Scalar>> vertices(input.vertices);
  const Eigen::Map<const Eigen::Matrix3<Data<Scalar>>> compliance(input.compliance);
  return {vertices, compliance};
}
template <typename Scalar, int k>
typename EquilibriumElement<Scalar, k>::Stress particular_of(const HybridInput<Scalar, k>& input) {
  const Eigen::Matrix3<Scalar> at_vertices =
      Eigen::Map<const Eigen::Matrix3<Scalar>>(input.particular);
  return linear_stress<k>(at_vertices);
}

// Element: EquilibriumElement, CurvedElement.
template <typename Element, typename Scalar, int k>
HybridStiffness<Scalar, k> stiffness_of(const Element& element, const HybridInput<Scalar, k>& input,
                                        bool loaded) {
  typename Element::Root R = element.root();
  for (int i = 0; i < R.rows(); ++i) to_unknowns(input, &R(i, 0));
  HybridStiffness<Scalar, k> result;
  Element::square(R, result.lower);
  for (Scalar& force : result.load) force = 0;
  if (loaded) {
    const typename Element::Stress particular = particular_of(input);
    const typename Element::OnEdges forces = element.edge_forces(particular);
    std::copy_n(forces.data(), forces.size(), result.load);
    to_unknowns(input, result.load);
    element.subtract_outer_load(R, particular, result.load);
  }
  result.independence = element.independence();
  return result;
}

template <typename Element, typename Scalar, int k>
HybridStress<Scalar, k> stress_of(const Element& element, const HybridInput<Scalar, k>& input,
                                  bool loaded, typename Element::OnEdges displacement) {
  to_walk(input, displacement.data());
  const typename Element::Stress total =
      loaded ? element.stress(displacement, particular_of(input)) : element.stress(displacement);
  const typename Element::Defect defect = element.defect(displacement, total);
  HybridStress<Scalar, k> result;
  const typename Element::OnEdges forces = element.edge_forces(total);
  std::copy_n(total.data(), total.size(), result.stress);
  std::copy_n(forces.data(), forces.size(), result.forces);
  to_unknowns(input, result.forces);
  std::copy_n(defect.forces.data(), defect.forces.size(), result.defect);
  to_unknowns(input, result.defect);
  result.defect_energy = defect.energy;
  return result;
}

template <typename Scalar, int k>
HybridStiffness<Scalar, k> hybrid_stiffness(const HybridInput<Scalar, k>& input, bool loaded) {
  return stiffness_of(element_of(input), input, loaded);
}

template <typename Scalar, int k>
HybridStress<Scalar, k> hybrid_stress(
    const HybridInput<Scalar, k>& input, bool loaded,
    typename EquilibriumElement<Scalar, k>::OnEdges displacement) {
  return stress_of(element_of(input), input, loaded, displacement);
}

}  // namespace airybench
