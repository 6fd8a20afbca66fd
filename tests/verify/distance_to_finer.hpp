// How far a stress is from the solution on a finer mesh.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "tests/verify/solved_body.hpp"

namespace airybench::testing {

// The stress of a coarse element at barycentric coordinates.
inline Eigen::Vector3d stress_at(const ElementStress& stress, const Eigen::Vector3d& lambda) {
  int opposite = 0;
  const double least = lambda.minCoeff(&opposite);
  const int t = (opposite + 1) % 3;  // the third between the other two corners
  return stress.middleCols<3>(3 * t) *
         Eigen::Vector3d(lambda(t) - least, lambda((t + 1) % 3) - least, 3 * least);
}

// √∫ (σ − fine):C:(σ − fine) for stresses of degree 1, by the centroids of the fine thirds. The
// fine mesh is the coarse one, uniformly refined.
inline double distance_to_finer(const Problem& coarse, const StressField& stress,
                                const Solved& fine) {
  const Problem& problem = *fine.system.problem;
  const std::size_t children = fine.hybrid.stress.size() / stress.size();
  double squared = 0;
  for (std::size_t t = 0; t < fine.hybrid.stress.size(); ++t) {
    const int triangle = static_cast<int>(t), parent = static_cast<int>(t / children);
    const TriangleVertices v = problem.vertices_of(triangle), p = coarse.vertices_of(parent);
    Eigen::Matrix3d barycentric;
    barycentric << p, Eigen::RowVector3d::Ones();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d x = (v.col(k) + v.col((k + 1) % 3) + v.rowwise().mean()) / 3;
      const Eigen::Vector3d lambda = barycentric.inverse() * Eigen::Vector3d(x.x(), x.y(), 1);
      const Eigen::Vector3d d = stress_at(stress[parent], lambda) -
                                fine.hybrid.stress[t].middleCols<3>(3 * k).rowwise().mean();
      squared += problem.area_mm2(triangle) / 3 * d.dot(problem.compliance_of(triangle) * d);
    }
  }
  return std::sqrt(squared);
}

}  // namespace airybench::testing
