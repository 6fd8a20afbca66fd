// The problem of a scene on a mesh, and its system.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/problem/pose.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::testing {

inline std::shared_ptr<const Problem> posed(const Scene& scene, Mesh mesh = small_tooth(6, 5)) {
  return std::make_shared<const Problem>(pose(scene, std::move(mesh)));
}

inline DualSystem system_of(const Scene& scene = {}, Mesh mesh = small_tooth(6, 5)) {
  return assemble(posed(scene, std::move(mesh)));
}

// Calls visit(row, t, k) for every edge of the boundary: it is side k of triangle t.
template <typename Visit>
void visit_boundary(const Problem& problem, const Visit& visit) {
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k)
        if (problem.edges.of_triangle[t][k] == problem.edges.of_boundary[row]) visit(row, t, k);
}

}  // namespace airybench::testing
