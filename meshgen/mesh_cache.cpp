#include "meshgen/mesh_cache.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/sha256.hpp"

namespace airybench {
namespace {

constexpr const char* made_by = "airybench converts models, 6";  // another number: other meshes

std::filesystem::path folder_of_variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::filesystem::path notes_of(std::filesystem::path mesh) {
  return mesh.replace_extension(".notes");
}

}  // namespace

std::filesystem::path cache_folder() {
  const std::filesystem::path own = folder_of_variable("AIRYBENCH_CACHE_DIR");
  if (!own.empty()) return own;
  const std::filesystem::path caches = folder_of_variable("XDG_CACHE_HOME");
  if (caches.is_absolute()) return caches / "airybench";
  const std::filesystem::path home = folder_of_variable("HOME");
  return home.is_absolute() ? home / ".cache" / "airybench" : "";
}

std::filesystem::path cached_file(const std::filesystem::path& model, const ModelOptions& options) {
  if (format_of(model) == ModelFormat::other) return "";
  const GeoScript script = what_is_read(model);
  const std::filesystem::path folder = cache_folder();
  if (!script.is_self_contained || script.has_unknown_words || folder.empty()) return "";
  std::string inputs = fmt::format("{}\nGmsh {}\n{}", made_by, version_of_gmsh(), text_of(options));
  for (const std::filesystem::path& file : script.files)
    inputs += fmt::format("file {}{}\n", sha256_of_file(file), file.extension().string());
  return folder / (sha256_hex(inputs) + ".msh");
}

std::optional<ConvertedModel> cached_model(const std::filesystem::path& file) {
  try {
    ConvertedModel kept{read_msh(file), {}};
    if (std::error_code error; !std::filesystem::exists(notes_of(file), error)) return kept;
    std::istringstream notes(file_text(notes_of(file)));
    for (std::string note; std::getline(notes, note);) kept.notes.push_back(note);
    return kept;
  } catch (const InputError&) {
    return {};
  }
}

std::optional<std::string> keep_model(const std::filesystem::path& file,
                                      const ConvertedModel& converted) {
  std::string notes;
  for (const std::string& note : converted.notes) notes += note + "\n";
  try {
    make_folder(file.parent_path());
    if (!notes.empty())
      write_file_atomically(notes_of(file), notes);  // first: a mesh has its notes
    write_file_atomically(file, msh_text(converted.mesh));
    return {};
  } catch (const FileError& error) {
    return error.what();
  }
}

}  // namespace airybench
