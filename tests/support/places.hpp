// Where tests find what they need: the build tree is the one they were built in.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "mesh/msh_format.hpp"

namespace airybench::testing {

inline std::filesystem::path build_folder() {
  auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  while (!std::filesystem::exists(folder / "CMakeCache.txt")) {
    if (folder == folder.parent_path()) throw std::runtime_error("not in a build tree");
    folder = folder.parent_path();
  }
  return folder;
}

inline std::filesystem::path source_folder() {
  return std::filesystem::canonical(build_folder() / "source");
}
inline std::filesystem::path mesh_folder() { return source_folder() / "meshgen" / "meshes"; }
inline std::filesystem::path mesh_file(const std::string& name) {
  return mesh_folder() / (name + ".msh");
}
inline Mesh catalogue_mesh(const std::string& name) { return read_msh(mesh_file(name)); }
inline std::filesystem::path results_folder() { return source_folder() / "results"; }
inline std::filesystem::path stability_scenes_folder() {
  return source_folder() / "bench" / "scenes" / "stability";
}
inline std::filesystem::path test_data(const std::string& name) {
  return source_folder() / "tests" / "data" / name;
}
inline std::filesystem::path bench_executable() { return build_folder() / "bench" / "bench"; }
inline std::filesystem::path meshgen_executable() { return build_folder() / "meshgen" / "meshgen"; }

}  // namespace airybench::testing
