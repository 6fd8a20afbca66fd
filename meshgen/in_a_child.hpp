#pragma once

#include <filesystem>
#include <functional>

#include "meshgen/convert.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

// Works on a user's model in a child process, which starts no other program (no_programs.hpp), and
// returns the exit code. Where Gmsh crashes, it works once more with Gmsh's algorithm 6 and says so
// in a note; where that crashes too, the complaint names file and cause.
int in_a_child(const std::filesystem::path& model, const ModelOptions& options,
               const std::function<int(const ModelOptions&, const AboutToMesh&)>& work);

}  // namespace airybench
