#pragma once

#include <filesystem>
#include <string>

#include "bench/plan/options.hpp"

namespace airybench {

// A scene file for a model, with each of its groups and bodies and with values to fill in: roles of
// the curves that the model itself gives none, materials, boundary values. Throws FileError.
std::string new_scene_text(const std::filesystem::path& model, const Options& options);

// Writes it to "part.json" in the current folder; returns the name. Throws FileError, also where
// that file is there.
std::string write_new_scene(const std::filesystem::path& model, const Options& options);

}  // namespace airybench
