#include "bench/plan/mesh_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "bench/plan/model_files.hpp"
#include "bench/records/case_name.hpp"
#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/refinement.hpp"
#include "mesh/selection.hpp"
#include "support/atomic_file.hpp"
#include "support/data_folder.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"

namespace airybench {

std::filesystem::path mesh_directory() {
  const char* own = std::getenv("AIRYBENCH_MESH_DIR");
  return own != nullptr && *own != '\0' ? own : data_folder("meshes");
}

namespace {

void check_name(const Mesh& mesh, const std::filesystem::path& path) {
  if (!is_name(mesh.name))
    throw std::invalid_argument(
        shortened(path.string()) +
        ": a mesh is named as its file (allowed: UTF-8 without control characters)");
}

MeshFile converted(const std::filesystem::path& model, const MeshChoice& choice) {
  constexpr std::size_t digits = 8;
  std::istringstream in(mesh_text_of_model(model, choice.model_settings));
  MeshFile file{{}, "", read_msh(in, model.string()), true};
  check_name(file.mesh, model);
  file.sha256 = sha256_hex(msh_text(file.mesh));
  const std::string& name = file.mesh.name;
  file.path =
      choice.out / "meshes" / (name + "." + file.sha256.substr(0, digits)) / (name + ".msh");
  return file;
}

// Of the catalogue; made in memory, its file is never there.
MeshFile refined_mesh(const std::filesystem::path& path, const RefinedName& refined) {
  MeshFile file{path, "", read_msh(path.parent_path() / (std::string(refined.name) + ".msh"))};
  for (int i = 0; i < refined.times; ++i) file.mesh = uniformly_refined(file.mesh);
  file.mesh.name = path.stem().string();
  file.sha256 = sha256_hex(msh_text(file.mesh));
  return file;
}

MeshFile read_or_convert(const std::filesystem::path& path, const MeshChoice& choice) {
  const ModelFormat format = format_of(path);
  if (format == ModelFormat::geo || format == ModelFormat::cad) return converted(path, choice);
  try {
    return read_mesh_file(path);
  } catch (const ForeignMeshError&) {
    if (!can_convert_models()) throw;
  }
  return converted(path, choice);
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path) {
  if (is_of_catalogue(path))
    if (const auto refined = parse_refined_name(path.stem().string()))
      return refined_mesh(path, *refined);
  Mesh mesh = read_msh(path);
  check_name(mesh, path);
  return {path, sha256_of_file(path), std::move(mesh)};
}

std::vector<MeshFile> read_meshes(const MeshChoice& choice) {
  std::vector<MeshFile> files;
  for (const std::string& item : expand_mesh_selection(choice.selection)) {
    const std::filesystem::path path =
        is_mesh_file(item) ? std::filesystem::path(item) : mesh_directory() / (item + ".msh");
    MeshFile file = read_or_convert(path, choice);
    for (const MeshFile& earlier : files)
      if (earlier.mesh.name == file.mesh.name)
        throw std::invalid_argument("two meshes are named " + file.mesh.name + ": " +
                                    earlier.path.string() + " and " + path.string() +
                                    "; records could not tell them apart");
    files.push_back(std::move(file));
  }
  if (!choice.model_settings.empty() && std::ranges::none_of(files, &MeshFile::is_of_model))
    throw std::invalid_argument(shortened(choice.model_settings.front()) +
                                ": no Gmsh model is among the meshes (allowed: with --mesh=" +
                                std::string(model_extensions) + ")");
  return files;
}

bool is_of_catalogue(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(),
                                     mesh_directory(), ignored);
}

void keep_models(const std::vector<MeshFile>& files) {
  for (const MeshFile& file : files) {
    if (!file.is_of_model) continue;
    make_folder(file.path.parent_path());
    write_file_atomically(file.path, msh_text(file.mesh));
  }
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
