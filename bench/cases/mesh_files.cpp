#include "bench/cases/mesh_files.hpp"

#include <cstdlib>
#include <stdexcept>

#include "bench/records/case_name.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/selection.hpp"
#include "support/data_folder.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {

std::filesystem::path mesh_directory() {
  const char* own = std::getenv("AIRYBENCH_MESH_DIR");
  return own != nullptr && *own != '\0' ? own : data_folder("meshes");
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
  Mesh mesh = read_msh(path);
  if (!is_name(mesh.name))
    throw std::invalid_argument(
        shortened(path.string()) +
        ": a mesh is named as its file (allowed: UTF-8 without control characters)");
  return {path, sha256_of_file(path), std::move(mesh)};
}

std::vector<MeshFile> read_meshes(const std::string& selection) {
  std::vector<MeshFile> files;
  for (const std::string& item : expand_mesh_selection(selection)) {
    const std::filesystem::path path =
        is_mesh_file(item) ? std::filesystem::path(item) : mesh_directory() / (item + ".msh");
    MeshFile file = read_mesh_file(path);
    for (const MeshFile& earlier : files)
      if (earlier.mesh.name == file.mesh.name)
        throw std::invalid_argument("two meshes are named " + file.mesh.name + ": " +
                                    earlier.path.string() + " and " + path.string() +
                                    "; records could not tell them apart");
    files.push_back(std::move(file));
  }
  return files;
}

bool is_of_catalogue(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::equivalent(file.parent_path(), mesh_directory(), ignored);
}

std::string recorded_path(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto whole = [](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  if (is_of_catalogue(file)) return file.filename().string();
  const std::filesystem::path from_folder = whole(file).lexically_relative(whole(folder));
  return from_folder.has_parent_path() ? from_folder.string() : "./" + from_folder.string();
}

std::filesystem::path recorded_file(const std::string& recorded,
                                    const std::filesystem::path& folder) {
  return recorded.find('/') == recorded.npos ? mesh_directory() / recorded : folder / recorded;
}

}  // namespace airybench
