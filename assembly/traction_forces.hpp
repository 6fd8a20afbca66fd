// Prescribed tractions as forces F_j of an edge (equilibrium_element.hpp, curved_side.hpp).
#pragma once

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

// F_j of the prescribed traction on an edge of Γ_F, from its start on; N. On a chord it is linear,
// and its control values lie on it.
template <typename Scalar>
Eigen::Matrix2X<Scalar> traction_forces(const Problem& problem, int row, int degree) {
  const BoundaryEdge& edge = problem.mesh.boundary[row];
  const Eigen::Vector2d &a = problem.mesh.vertices[edge.vertices[0]],
                        &b = problem.mesh.vertices[edge.vertices[1]];
  if (problem.follows_curve(row, degree)) {
    const CurvedSide<Scalar> side(problem.curve_of(row, degree), degree);
    Eigen::Matrix2X<Scalar> density(2, CurvedSide<Scalar>::points);
    for (int q = 0; q < density.cols(); ++q) {
      const Scalar length = side.normal(q).norm();
      const Eigen::Vector2d x = side.at(q).template cast<double>(),
                            n = (side.normal(q) / length).template cast<double>();
      density.col(q) = length * problem.loads.traction_MPa(x, n, row).template cast<Scalar>();
    }
    return side.forces(density);
  }
  const EdgeFrame frame = edge_frame(a, b);
  const Eigen::Vector2d start = problem.loads.traction_MPa(a, frame.normal, row),
                        end = problem.loads.traction_MPa(b, frame.normal, row);
  Eigen::Matrix2X<Scalar> forces(2, degree + 1);
  for (int j = 0; j <= degree; ++j)
    forces.col(j) = (frame.length_mm / (degree + 1) * ((degree - j) * start + j * end) / degree)
                        .template cast<Scalar>();
  return forces;
}

}  // namespace airybench
