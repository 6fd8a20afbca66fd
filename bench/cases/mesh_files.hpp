// Finding and reading the meshes that a selection names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

struct MeshFile {
  std::filesystem::path path;
  std::string sha256;
  Mesh mesh;
};

// The folder of Mesh0..Mesh7: $AIRYBENCH_MESH_DIR, or the one that comes with this program.
std::filesystem::path mesh_directory();

// Reads all that mesh_selection.hpp's expand_mesh_selection() names. Throws MeshError,
// std::invalid_argument; two files of the same name are refused.
std::vector<MeshFile> read_meshes(const std::string& selection);

}  // namespace airybench
