// The problem of a scene on a mesh, and its system.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/scene.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::testing {

inline std::shared_ptr<const Problem> posed(const Scene& scene, Mesh mesh = small_tooth(6, 5)) {
  return std::make_shared<const Problem>(pose(scene, std::move(mesh)));
}

inline DualSystem system_of(const Scene& scene = {}, Mesh mesh = small_tooth(6, 5)) {
  return assemble(posed(scene, std::move(mesh)));
}

}  // namespace airybench::testing
