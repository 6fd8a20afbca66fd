#include "bench/plan/mesh_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bench/records/case_name.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/refinement.hpp"
#include "mesh/selection.hpp"
#include "support/atomic_file.hpp"
#include "support/data_folder.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"
#include "support/sign_of_life.hpp"

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

constexpr const char* converter = "meshgen";

// Next to this program; where it has not been built, ./run says how.
std::optional<std::filesystem::path> converter_program() {
  auto program = program_of_ours(converter);
  const char* const build = std::getenv("AIRYBENCH_BUILD_MESHGEN");
  if (!program && build != nullptr && std::system(build) == 0) program = program_of_ours(converter);
  return program;
}

// The last of its complaints, with the table that may follow.
std::string complaint_of(const ProgramEnd& end) {
  if (end.signal != 0)
    return fmt::format("{} was ended by a signal: {}", converter, strsignal(end.signal));
  std::string text = "\n" + end.err;
  while (text.ends_with('\n')) text.pop_back();
  const std::string prefix = fmt::format("\n{}: ", converter);
  if (const std::size_t at = text.rfind(prefix); at != text.npos)
    return text.substr(at + prefix.size());
  return fmt::format("{} ended with exit code {}: {}", converter, end.exit_code,
                     text.substr(text.rfind('\n') + 1));
}

// bench does not link Gmsh, so meshgen reads models in a separate process; its notes go to standard
// error. mode: --convert, --show, --scene; settings: options of these. Throws FileError.
std::string said_of_model(const std::string& mode, const std::filesystem::path& model,
                          const std::vector<std::string>& settings) {
  const auto program = converter_program();
  if (!program)
    throw FileError(
        fmt::format("{}: a Gmsh model, but there is no {} next to this program (Debian: "
                    "install libgmsh-dev and build again, as ./run bench does)",
                    model.string(), converter));
  std::vector<std::string> arguments = {mode + "=" + model.string()};
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  constexpr double no_limit_s = std::numeric_limits<double>::infinity();  // it has its own
  ProgramEnd end = run_program(*program, arguments, no_limit_s);
  if (end.exit_code != 0) throw FileError(complaint_of(end));
  std::cerr << without_signs_of_life(end.err);
  return std::move(end.out);
}

using Settings = std::vector<std::string>;

Settings to_standard_output(Settings settings) {
  settings.emplace_back("--out=-");
  return settings;
}

MeshFile converted(const std::filesystem::path& model, const std::filesystem::path& out,
                   const Settings& settings) {
  constexpr std::size_t digits = 8;
  std::istringstream in(said_of_model("--convert", model, to_standard_output(settings)));
  MeshFile file{{}, "", read_msh(in, model.string()), true};
  file.mesh.name = model_name(model);
  check_name(file.mesh, model);
  file.sha256 = sha256_hex(msh_text(file.mesh));
  const std::string& name = file.mesh.name;
  file.path = out / "meshes" / (name + "." + file.sha256.substr(0, digits)) / (name + ".msh");
  return file;
}

// Refines in memory; no file exists at `path`.
MeshFile refined_mesh(const std::filesystem::path& path, const RefinedName& refined) {
  MeshFile file{path, "", read_msh(path.parent_path() / (std::string(refined.name) + ".msh"))};
  for (int i = 0; i < refined.times; ++i) file.mesh = uniformly_refined(file.mesh);
  file.mesh.name = path.stem().string();
  file.sha256 = sha256_hex(msh_text(file.mesh));
  return file;
}

// Sizes and parameters are of models that have no mesh yet.
bool changes_any_mesh(const std::string& setting) {
  return setting.starts_with(role_setting.option) ||
         setting.starts_with(length_unit_setting.option);
}

MeshFile read_or_convert(const std::filesystem::path& path, const std::filesystem::path& out,
                         const Settings& settings) {
  const ModelFormat format = format_of(path);
  const bool is_msh =
      (format == ModelFormat::msh || format == ModelFormat::other) && !is_gzipped(path);
  const bool is_as_it_is =
      is_of_catalogue(path) || std::ranges::none_of(settings, changes_any_mesh);
  if (!is_msh || !is_as_it_is) return converted(path, out, settings);
  try {
    return read_mesh_file(path);
  } catch (const ForeignMeshError&) {
    if (is_of_catalogue(path) || !converter_program()) throw;
  }
  return converted(path, out, settings);
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path) {
  if (is_of_catalogue(path))
    if (const auto refined = parse_refined_name(path.stem().string()))
      return refined_mesh(path, *refined);
  MeshFile file{path, "", {}};
  file.mesh = read_msh(path, &file.notes);
  check_name(file.mesh, path);
  file.sha256 = sha256_of_file(path);
  return file;
}

std::vector<MeshFile> read_meshes(const RunSettings& run, const std::filesystem::path& out,
                                  const Settings& of_scene) {
  Settings settings = run.model_settings;
  settings.insert(settings.end(), of_scene.begin(), of_scene.end());
  std::vector<MeshFile> files;
  for (const std::string& item : expand_mesh_selection(run.meshes)) {
    const std::filesystem::path path =
        is_mesh_file(item) ? std::filesystem::path(item) : mesh_directory() / (item + ".msh");
    MeshFile file = read_or_convert(path, out, settings);
    for (const MeshFile& earlier : files)
      if (earlier.mesh.name == file.mesh.name)
        throw std::invalid_argument("two meshes are named " + file.mesh.name + ": " +
                                    earlier.path.string() + " and " + path.string() +
                                    "; records could not tell them apart");
    files.push_back(std::move(file));
  }
  if (!settings.empty() && std::ranges::none_of(files, &MeshFile::is_of_model))
    throw std::invalid_argument(shortened(settings.front()) +
                                ": no Gmsh model is among the meshes (allowed: with --mesh=" +
                                std::string(model_extensions) + ")");
  return files;
}

std::string curves_of_model(const std::filesystem::path& model, const Settings& settings) {
  return said_of_model("--show", model, to_standard_output(settings));
}

std::string scene_of_deck(const std::filesystem::path& deck, const Settings& limits) {
  return said_of_model("--scene", deck, limits);
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
