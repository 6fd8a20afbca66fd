// The problem of a scene on a mesh, and its system.
#pragma once

#include "assembly/airy_system.hpp"
#include "assembly/problem/pose.hpp"
#include "mesh/boundary_sides.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::testing {

inline std::shared_ptr<const Problem> posed(const Scene& scene, Mesh mesh = small_tooth(6, 5)) {
  return std::make_shared<const Problem>(pose(scene, std::move(mesh)));
}

inline AirySystem system_of(const Scene& scene = {}, Mesh mesh = small_tooth(6, 5)) {
  return airy_system(posed(scene, std::move(mesh)));
}

// Calls visit(row, t, k) for every edge of the boundary: it is side k of triangle t.
template <typename Visit>
void visit_boundary(const Problem& problem, const Visit& visit) {
  const std::vector<TriangleSide> sides = boundary_sides(problem.edges);
  for (int row = 0; row < static_cast<int>(sides.size()); ++row) {
    const TriangleSide& side = sides[static_cast<std::size_t>(row)];
    visit(row, side.triangle, side.k);
  }
}

}  // namespace airybench::testing
