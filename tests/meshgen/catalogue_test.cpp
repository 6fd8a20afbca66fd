#include "meshgen/catalogue.hpp"

#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "mesh/selection.hpp"
#include "meshgen/checksums.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/mesh_check.hpp"
#include "meshgen/tooth_mesh.hpp"
#include "support/sha256.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/test_folder.hpp"

namespace airybench::catalogue_test {
namespace {

const std::filesystem::path repository = testing::mesh_folder();

TEST(Catalogue, RowsObeyTheCountingFormulas) {
  for (const CatalogueRow& row : catalogue) {
    EXPECT_EQ(row.paper_n_phi, 6 * row.vertices - row.edges.total() - 3) << row.name;
    EXPECT_EQ(row.paper_n_f, 4 * row.edges.force) << row.name;
    EXPECT_EQ(row.name == "Mesh0" ? mesh0_n_c : row.paper_n_c, 4 * row.edges.contact) << row.name;
  }
}

TEST(Catalogue, HasTheNamesOfTheSelection) {
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    EXPECT_EQ(catalogue[i].name, catalogue_mesh_names[i]);
    EXPECT_EQ(&catalogue_row(catalogue_mesh_names[i]), &catalogue[i]);
  }
  EXPECT_EQ(catalogue.size(), catalogue_mesh_names.size());
  EXPECT_THROW(catalogue_row("Mesh8"), std::invalid_argument);
}

TEST(Catalogue, FilesInTheRepositoryFitTab1) {
  const auto checked = check_folder(repository);
  ASSERT_EQ(checked.size(), catalogue.size());
  for (const CheckedMesh& mesh : checked) {
    EXPECT_TRUE(mesh.differences.empty()) << mesh.differences.front();
    EXPECT_GE(mesh.quality.smallest_angle_deg, 20) << mesh.row->name;
    EXPECT_EQ(mesh.triangles, 2 * mesh.vertices - mesh.row->edges.total() - 2) << mesh.row->name;
  }
}

TEST(Catalogue, Mesh0And4AreMadeAnewByteForByte) {
  const GmshSession session;
  if (gmsh_version() != catalogue_gmsh_version)
    GTEST_SKIP() << "the files are of Gmsh " << catalogue_gmsh_version << ", this is "
                 << gmsh_version();
  for (const char* name : {"Mesh0", "Mesh4", "Mesh0"}) {  // no history in Gmsh's global state
    if (testing::sanitized && std::string(name) == "Mesh4") continue;
    const Mesh mesh = make_catalogue_mesh(catalogue_row(name));
    EXPECT_EQ(sha256_hex(msh_text(mesh)),
              sha256_of_file(repository / (std::string(name) + ".msh")));
  }
}

TEST(CheckMesh, NamesEveryDifference) {
  const Mesh mesh = read_msh(repository / "Mesh0.msh");
  EXPECT_TRUE(check_mesh(catalogue[0], mesh).differences.empty());
  const auto differences =
      check_mesh(catalogue[0], testing::with_role(mesh, BoundaryRole::contact, BoundaryRole::force))
          .differences;
  EXPECT_EQ(differences.size(), 4u);
  for (std::size_t k = 0; k < differences.size(); ++k)
    testing::expect_named(differences[k],
                          {std::array{"n_f is 136", "n_C is 0", "force is 34", "contact is 0"}[k]});
  Mesh flat = mesh;
  for (auto& vertex : flat.vertices) vertex.y() *= 0.1;
  const auto of_flat = check_mesh(catalogue[0], flat).differences;
  ASSERT_EQ(of_flat.size(), 1u);
  testing::expect_named(of_flat[0], {"Mesh0: smallest angle is "});
}

TEST(ToothMesh, NaturalSizeKeepsTheBoundary) {
  const GmshSession session;
  const EdgeCounts edges{5, 40, 13};
  ToothDimensions rack;
  rack.teeth = 3;
  const Mesh mesh = tooth_mesh(rack, edges, std::nullopt, "rack");
  EXPECT_EQ(mesh.name, "rack");
  const MeshSizes sizes = mesh_sizes(mesh);
  EXPECT_EQ(sizes.displacement_edges, 5);
  EXPECT_EQ(sizes.force_edges, 40);
  EXPECT_EQ(sizes.contact_edges, 13);
  const BoundaryPolygon polygon = boundary_polygon(rack, edges);
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    EXPECT_EQ(mesh.vertices[i], polygon.vertices[i]);
    EXPECT_EQ(mesh.boundary[i].role, polygon.roles[i]);
  }
}

TEST(ToothMesh, WantedNumberOfVertices) {
  const GmshSession session;
  for (const int vertices : {80, 101, 177})
    EXPECT_EQ(tooth_mesh({}, {6, 20, 8}, vertices, "tooth").vertices.size(),
              static_cast<std::size_t>(vertices));
  EXPECT_THROW(tooth_mesh({}, {6, 20, 8}, 33, "tooth"), std::invalid_argument);
}

TEST(Checksums, ReadWhatWasWrittenAndWhatSha256sumWrites) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder / "Mesh3.msh", "abc");
  testing::write_text(folder / "notes.txt", "abc");
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  const std::string text = checksums_of_folder(folder.path());
  EXPECT_EQ(text, abc + "  Mesh3.msh\n");
  const auto sums = read_checksums(testing::write_text(folder / "SHA256SUMS", text));
  EXPECT_EQ(sums, (std::map<std::string, std::string>{{"Mesh3.msh", abc}}));
}

TEST(Checksums, RefusesOtherLines) {
  const testing::TemporaryFolder folder;
  const auto file = testing::write_text(folder / "SHA256SUMS", "Mesh3.msh abc\n");
  testing::expect_named(testing::complaint_of<std::runtime_error>([&] { read_checksums(file); }),
                        {file.string() + ":1: "});
}

}  // namespace
}  // namespace airybench::catalogue_test
