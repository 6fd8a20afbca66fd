#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airybench {

// A scene file for a model, with each of its groups and bodies and with values to fill in: roles of
// the curves that the model itself gives none, materials, boundary values. settings: for meshgen,
// as RunSettings::model_settings. Throws FileError.
std::string new_scene_text(const std::filesystem::path& model,
                           const std::vector<std::string>& settings);

// Writes it to "part.json" in the current folder; returns the name. Throws FileError, also where
// that file is there.
std::string write_new_scene(const std::filesystem::path& model,
                            const std::vector<std::string>& settings);

}  // namespace airybench
