// What a scene says of a mesh's bodies, in the order of Mesh::body_names.
#pragma once

#include <string>
#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench {

// Throw SceneError: a body that the mesh lacks; a warm one whose material has no expansion.
std::vector<Material> materials(const Scene& scene, const Mesh& mesh);
// Empty: none is warm. prefix: of a load step, for messages.
std::vector<ThermalStrain> thermal_strains(const Scene& scene, const std::string& prefix,
                                           const Mesh& mesh);

}  // namespace airybench
