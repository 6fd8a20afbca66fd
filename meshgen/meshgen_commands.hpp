// What the `meshgen` command does; one function per mode. They print to standard output and return
// the exit code: 0 fine, 1 a difference was found. Complaints are thrown: std::invalid_argument for
// wrong usage, any other std::exception for what cannot be done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mesh/layers.hpp"
#include "mesh/transform.hpp"
#include "meshgen/model_options.hpp"
#include "meshgen/tooth_geometry.hpp"

namespace airybench {

// Makes catalogue meshes again and compares them with the files in `repository`; writes them and
// SHA256SUMS to `out` if given (made when missing).
int remake_command(const std::string& selection, const std::filesystem::path& repository,
                   const std::optional<std::filesystem::path>& out);

// Prints the files of `repository` next to the paper's Tab. 1.
int check_command(const std::filesystem::path& repository);

// Writes one tooth or rack of the user's own dimensions.
int tooth_command(const ToothDimensions& dimensions, const EdgeCounts& edges,
                  std::optional<int> vertices, const std::filesystem::path& out);

// Writes a user's Gmsh model in our format, to standard output where `out` is "-". What has been
// converted before comes from the cache (mesh_cache.hpp). Notes go to standard error. Gmsh works in
// a child process (in_a_child.hpp).
int convert_command(const std::filesystem::path& model, const ModelOptions& options,
                    const std::filesystem::path& out);

// Prints a table of a model's curves and draws them with their numbers into a PNG; where `out` is
// "-", writes what is drawn as JSON to standard output instead (json_of in roles.hpp).
int show_command(const std::filesystem::path& model, const ModelOptions& options,
                 const std::filesystem::path& out);

// Prints what an input deck prescribes as a scene; nothing where it is a mesh only. Notes go to
// standard error. options: their limits hold.
int scene_command(const std::filesystem::path& deck, const ModelOptions& options);

// Writes a changed mesh; `mesh` is a file, or a name in `repository`.
int modify_command(const std::string& mesh, const std::filesystem::path& repository,
                   const MeshTransform& transform, const Layers& layers,
                   const std::filesystem::path& out);

}  // namespace airybench
