#pragma once

#include <filesystem>
#include <functional>

#include "meshgen/convert.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

// Works on a user's model in a child process, which starts no other program and writes into
// `folder` alone (confinement.hpp), whatever the model says; where the kernel cannot do that,
// models are refused that have words which may need it. It is ended where it passes the options'
// limits of time and memory. Returns the exit code; `take` has the
// folder's files if it is 0. Where Gmsh crashes, it works once more with Gmsh's algorithm 6 and
// says so in a note; where that crashes too, the complaint names file and cause.
using InFolder = std::function<void(const std::filesystem::path& folder)>;
int in_a_child(const std::filesystem::path& model, const ModelOptions& options,
               const std::function<void(const ModelOptions&, const AboutToMesh&,
                                        const std::filesystem::path& folder)>& work,
               const InFolder& take);

}  // namespace airybench
