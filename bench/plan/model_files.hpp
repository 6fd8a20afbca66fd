// A user's Gmsh models, made into meshes by `meshgen`: a process of its own, because bench does not
// link Gmsh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace airybench {

// The mesh file's text. settings: options of `meshgen --convert`, "--role=clamped=displacement".
// Notes go to standard error. Throws FileError, one line: what is wrong with model or settings, or
// what to install.
std::string mesh_text_of_model(const std::filesystem::path& model,
                               const std::vector<std::string>& settings);

bool can_convert_models();  // meshgen is there

}  // namespace airybench
