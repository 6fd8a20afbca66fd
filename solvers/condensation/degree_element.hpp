// One triangle of the hybridized system (hybridized.hpp) with stresses of degree 2 and more
// (equilibrium_element.hpp), in the components of EdgeUnknowns. Degree 1 has vectorised kernels
// (hybrid_kernels.hpp).
#pragma once

#include "assembly/equilibrium_element.hpp"
#include "assembly/problem.hpp"

namespace airybench {

template <typename Scalar>
struct DegreeInput {
  TriangleVerticesFor<Scalar> vertices;
  Eigen::Matrix3<Data<Scalar>> compliance;
  Eigen::Matrix3<Scalar> particular;  // σ_p at the vertices
  std::array<bool, 3> from_start;     // the edge's moments follow the element's walk
  std::array<bool, 3> in_frame;       // its components are in `frame`, else x and y
  std::array<std::array<EdgeFrameIn<Scalar>, highest_stress_degree + 1>, 3> frame;  // per moment
};

// What comes out are plain arrays, of the sizes of StressDegree and as in hybrid_element.hpp.
template <typename Scalar>
struct DegreeKernels {
  // Returns the element's independence.
  Scalar (*stiffness)(const DegreeInput<Scalar>& input, bool loaded, Scalar* lower, Scalar* load);
  // Returns the defect's energy.
  Scalar (*stress)(const DegreeInput<Scalar>& input, bool loaded, const Scalar* displacement,
                   Scalar* stress, Scalar* forces, Scalar* defect);
};

// Throws std::invalid_argument where there is no such degree.
template <typename Scalar>
const DegreeKernels<Scalar>& degree_kernels(int degree);

// rows: per edge (rows_in_frame).
template <typename Scalar>
DegreeInput<Scalar> degree_input(const Problem& problem, const std::vector<int>& rows, int degree,
                                 int triangle);

}  // namespace airybench
