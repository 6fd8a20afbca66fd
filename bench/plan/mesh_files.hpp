// Finds and reads the meshes that a selection names.
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
  bool is_of_model = false;             // converted from a model: the file may not exist yet
  std::vector<std::string> notes = {};  // of mend()
};

std::filesystem::path mesh_directory();  // $AIRYBENCH_MESH_DIR, else the program's own catalogue

// Makes Mesh3+refine2.msh of the catalogue from Mesh3 in memory and hashes its MSH text. Throws
// MeshError, or std::invalid_argument if the file name is not a valid mesh name.
MeshFile read_mesh_file(const std::filesystem::path& path);

// Reads the run's meshes; meshgen converts models and foreign MSH files, by the run's and these
// settings; out: the results folder, where keep_models() writes them. Throws MeshError, FileError,
// or std::invalid_argument (two meshes have one name; there are settings, but there is no model).
std::vector<MeshFile> read_meshes(const RunSettings& run, const std::filesystem::path& out,
                                  const std::vector<std::string>& settings = {});

// What `meshgen --show=MODEL --out=-` writes, with these settings. Throws FileError.
std::string curves_of_model(const std::filesystem::path& model,
                            const std::vector<std::string>& settings);

// What an input deck prescribes, as a scene; empty where it is a mesh only; limits: settings.
// Throws FileError.
std::string scene_of_deck(const std::filesystem::path& deck,
                          const std::vector<std::string>& limits);

// Writes converted meshes to OUT/meshes/NAME.HASH/NAME.msh, which no other mesh overwrites: HASH is
// the start of the SHA-256.
void keep_models(const std::vector<MeshFile>& files);

bool is_of_catalogue(const std::filesystem::path& file);

// A record in `folder` names a mesh of the catalogue by its file name, and another mesh by its path
// relative to the folder, as in "./part.msh". recorded_file() is the inverse.
std::string recorded_path(const std::filesystem::path& file, const std::filesystem::path& folder);
std::filesystem::path recorded_file(const std::string& recorded,
                                    const std::filesystem::path& folder);

}  // namespace airybench
