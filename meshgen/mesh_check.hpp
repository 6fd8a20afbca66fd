// Do the mesh files fit the paper's Tab. 1?
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/quality.hpp"
#include "meshgen/catalogue.hpp"

namespace airybench {

struct CheckedMesh {
  const CatalogueRow* row = nullptr;
  MeshSizes sizes;
  int vertices = 0;
  int triangles = 0;
  MeshQuality quality;
  std::vector<std::string> differences;  // one line each; empty: as the catalogue wants it
};

// Compares n_φ, n_f, n_C with the printed Tab. 1 (Mesh0's n_C with the documented 40), edges and
// vertices with the catalogue, the smallest angle with catalogue_least_angle_deg.
CheckedMesh check_mesh(const CatalogueRow& row, const Mesh& mesh);

// Reads and checks all eight files of a folder, and their hashes against its SHA256SUMS. Throws
// MeshError or std::runtime_error for a file that cannot be read.
std::vector<CheckedMesh> check_folder(const std::filesystem::path& folder);

}  // namespace airybench
