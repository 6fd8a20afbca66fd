// A user's model, open in Gmsh and meshed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

// While it lives, Gmsh's model is the file's, with a mesh of its surfaces: its own, or one that is
// made by the options. A CAD file gets physical groups: one of all surfaces, "body", and one of
// every curve, named by its number.
class OpenModel {
 public:
  // Throws InputError, what is wrong without the file's name, and std::string, Gmsh's message.
  OpenModel(const std::filesystem::path& file, const ModelOptions& options);

 private:
  // By what the .geo knows them as.
  struct Parameters {
    std::map<std::string, double> constants, onelab;
  };
  static Parameters parameters_of(const std::filesystem::path& file, const ModelOptions& options);
  OpenModel(const std::filesystem::path& file, const ModelOptions& options,
            const Parameters& parameters);

  GmshSession session_;
};

}  // namespace airybench
