// A user's model, open in Gmsh and meshed.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

// Called with Gmsh's number of the algorithm before Gmsh meshes, in which it may crash.
using AboutToMesh = std::function<void(int algorithm)>;

// While it lives, Gmsh's model is the file's, with a mesh of its surfaces: its own, or one that is
// made by the options.
class OpenModel {
 public:
  // Throws InputError, what is wrong without the file's name, and std::string, Gmsh's message.
  OpenModel(const std::filesystem::path& file, const ModelOptions& options,
            const AboutToMesh& about_to_mesh, std::vector<std::string>& notes);

  // By the length unit and the model's Mesh.ScalingFactor.
  double mm_per_unit() const { return mm_per_unit_; }

 private:
  // By what the .geo knows them as.
  struct Parameters {
    std::map<std::string, double> constants, onelab;
  };
  static Parameters parameters_of(const std::filesystem::path& file, const ModelOptions& options);
  OpenModel(const std::filesystem::path& file, const ModelOptions& options,
            const Parameters& parameters, const AboutToMesh& about_to_mesh,
            std::vector<std::string>& notes);

  GmshSession session_;
  double mm_per_unit_ = 1;
};

}  // namespace airybench
