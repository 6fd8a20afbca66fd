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

// Throws MeshError, std::invalid_argument: the file's name is no name of a mesh.
MeshFile read_mesh_file(const std::filesystem::path& path);

// Reads all that mesh_selection.hpp's expand_mesh_selection() names. Throws MeshError,
// std::invalid_argument; two files of the same name are refused.
std::vector<MeshFile> read_meshes(const std::string& selection);

bool is_of_catalogue(const std::filesystem::path& file);

// How a record in `folder` names a mesh's file: one of the catalogue's by its name alone, another
// by its path from the folder, "./part.msh".
std::string recorded_path(const std::filesystem::path& file, const std::filesystem::path& folder);
// And back.
std::filesystem::path recorded_file(const std::string& recorded,
                                    const std::filesystem::path& folder);

}  // namespace airybench
