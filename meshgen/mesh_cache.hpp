// Meshes of models that have been converted before.
//
// A mesh is kept under the SHA-256 of all that it depends on: the model's bytes and those of the
// files that it includes, the options, Gmsh's version. A model that depends on more, the time or a
// file whose name it computes, is not kept. The folder may be deleted at any time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "meshgen/convert.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

// $AIRYBENCH_CACHE_DIR, $XDG_CACHE_HOME/airybench or ~/.cache/airybench; empty: there is no home.
std::filesystem::path cache_folder();

// The file of a model's mesh there; empty: the model's mesh is not kept. Opens a GmshSession of its
// own (none may live). Throws FileError: the model cannot be read.
std::filesystem::path cached_file(const std::filesystem::path& model, const ModelOptions& options);

// Empty: it is not there, or no mesh.
std::optional<ConvertedModel> cached_model(const std::filesystem::path& file);

// Keeps mesh and notes where that is possible; returns why it is not.
std::optional<std::string> keep_model(const std::filesystem::path& file,
                                      const ConvertedModel& converted);

}  // namespace airybench
