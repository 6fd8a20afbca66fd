#include "meshgen/mesh_check.hpp"

#include <fmt/format.h>

#include "mesh/msh_format.hpp"
#include "meshgen/checksums.hpp"
#include "support/sha256.hpp"

namespace airybench {

CheckedMesh check_mesh(const CatalogueRow& row, const Mesh& mesh) {
  CheckedMesh checked{.row = &row,
                      .sizes = mesh_sizes(mesh),
                      .vertices = static_cast<int>(mesh.vertices.size()),
                      .triangles = static_cast<int>(mesh.triangles.size()),
                      .quality = mesh_quality(mesh),
                      .differences = {}};
  const auto expect = [&](const char* what, int found, int wanted) {
    if (found != wanted)
      checked.differences.push_back(
          fmt::format("{}: {} is {}, should be {}", row.name, what, found, wanted));
  };
  expect("n_phi", checked.sizes.n_phi, row.paper_n_phi);
  expect("n_f", checked.sizes.n_f, row.paper_n_f);
  expect("n_C", checked.sizes.n_c, row.name == "Mesh0" ? mesh0_n_c : row.paper_n_c);
  expect("edges on displacement", checked.sizes.displacement_edges, row.edges.displacement);
  expect("edges on force", checked.sizes.force_edges, row.edges.force);
  expect("edges on contact", checked.sizes.contact_edges, row.edges.contact);
  expect("vertices", checked.vertices, row.vertices);
  if (checked.quality.smallest_angle_deg < catalogue_least_angle_deg)
    checked.differences.push_back(
        fmt::format("{}: smallest angle is {:.2f} degrees, should be at "
                    "least {}",
                    row.name, checked.quality.smallest_angle_deg, catalogue_least_angle_deg));
  return checked;
}

std::vector<CheckedMesh> check_folder(const std::filesystem::path& folder) {
  const auto sums = read_checksums(folder / checksums_file_name);
  std::vector<CheckedMesh> checked;
  for (const CatalogueRow& row : catalogue) {
    const std::string file_name = std::string(row.name) + ".msh";
    const std::filesystem::path file = folder / file_name;
    CheckedMesh& mesh = checked.emplace_back(check_mesh(row, read_msh(file)));
    const auto sum = sums.find(file_name);
    if (sum == sums.end() || sum->second != sha256_of_file(file))
      mesh.differences.push_back(fmt::format("{}: {} has {} hash", row.name, checksums_file_name,
                                             sum == sums.end() ? "no" : "another"));
  }
  return checked;
}

}  // namespace airybench
