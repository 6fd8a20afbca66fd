// Finding and reading the meshes that a selection names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

struct MeshFile {
  std::filesystem::path path;
  std::string sha256;
  Mesh mesh;
  bool is_of_model = false;  // made of a model: the file may not be there yet
};

// The folder of Mesh0..Mesh7: $AIRYBENCH_MESH_DIR, or the one that comes with this program.
std::filesystem::path mesh_directory();

// Also Mesh3+refine2.msh beside Mesh3.msh of the catalogue, which is made in memory; its SHA-256 is
// that of the file it would be. Throws MeshError, std::invalid_argument: the file's name is no name
// of a mesh.
MeshFile read_mesh_file(const std::filesystem::path& path);

// Reads options.meshes. Models (model_format.hpp, and MSH files that are not of our form) are
// converted by meshgen; keep_models() writes what is made of them to
//   OUT/meshes/NAME.HASH/NAME.msh      HASH: the start of the file's SHA-256
// a file as any other, which records name and nothing else overwrites. Throws MeshError, FileError,
// std::invalid_argument; two files of the same name are refused, and settings without a model.
std::vector<MeshFile> read_meshes(const Options& options);
void keep_models(const std::vector<MeshFile>& files);

bool is_of_catalogue(const std::filesystem::path& file);

// How a record in `folder` names a mesh's file: one of the catalogue's by its name alone, another
// by its path from the folder, "./part.msh".
std::string recorded_path(const std::filesystem::path& file, const std::filesystem::path& folder);
// And back.
std::filesystem::path recorded_file(const std::string& recorded,
                                    const std::filesystem::path& folder);

}  // namespace airybench
