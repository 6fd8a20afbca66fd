// `meshgen` on the catalogue's meshes: changed, checked, made again.
#include "mesh/mesh.hpp"
#include "mesh/msh_format.hpp"
#include "meshgen/catalogue.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "support/sha256.hpp"
#include "tests/support/meshgen_command.hpp"

namespace airybench::catalogue_command_test {
namespace {

namespace fs = std::filesystem;
using testing::text_of, testing::write_text;
using Outcome = testing::MeshgenOutcome;

class CatalogueCommand : public testing::MeshgenCommand {};

using Names = std::vector<std::string>;

TEST_F(CatalogueCommand, ModifiesAMesh) {
  const Outcome outcome =
      run("--modify=Mesh0 --refine=1 --grade=10,0,100 --slivers=1e3,5 --scale=2 --stretch=1,0.5 "
          "--move=-1,3 --keep-contact-edges=4 --keep-displacement-edges=2 --layers=1,0,4 "
          "--out=new.msh");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Mesh mesh = read_msh(folder / "new.msh");
  EXPECT_EQ(mesh.name, "new");
  EXPECT_EQ(mesh.body_names, (Names{"layer 1", "layer 2", "layer 3", "layer 4"}));
  EXPECT_EQ(mesh_sizes(mesh).contact_edges, 4);
  EXPECT_EQ(mesh_sizes(mesh).displacement_edges, 2);
  double right = 0;
  for (const auto& vertex : mesh.vertices) right = std::max(right, vertex.x());
  EXPECT_EQ(right, 2 * 10 - 1);
  // What is written can be changed again.
  EXPECT_EQ(run("--modify=new.msh --keep-force-edges=0 --out=new.msh").exit_code, 0);
  EXPECT_EQ(mesh_sizes(read_msh(folder / "new.msh")).force_edges, 0);
  EXPECT_EQ(files(), Names{"new.msh"});
}

TEST_F(CatalogueCommand, ModifiedByNothingIsTheSameFile) {
  EXPECT_EQ(run("--modify=Mesh3 --out=same.msh").exit_code, 0);
  EXPECT_EQ(text_of(folder / "same.msh"), text_of(testing::mesh_file("Mesh3")));
}

TEST_F(CatalogueCommand, CheckOfTheRepositoryPasses) {
  const Outcome outcome = run("--check");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  for (const char* part : {"Mesh7", "50483", "Tab. 1 prints n_C = 38", "the mesh has 40"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

TEST_F(CatalogueCommand, CheckNoticesAnotherMeshAndAnotherHashAlsoByTheEnvironment) {
  fs::copy(testing::mesh_folder(), folder / "meshes");
  fs::copy_file(folder / "meshes/Mesh0.msh", folder / "meshes/Mesh1.msh",
                fs::copy_options::overwrite_existing);
  write_text(folder / "meshes/Mesh2.msh", text_of(folder / "meshes/Mesh2.msh") + "\n");
  for (const Outcome& outcome :
       {run("--check --meshes=meshes"), run("--check", "AIRYBENCH_MESH_DIR=meshes")}) {
    EXPECT_EQ(outcome.exit_code, 1);
    for (const char* part :
         {"Mesh1: n_phi is 761, should be 1973\n", "Mesh2: SHA256SUMS has another hash\n"})
      EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  }
}

TEST_F(CatalogueCommand, CheckNeedsTheFiles) {
  expect_refusal("--check --meshes=nowhere", 1, {"nowhere/SHA256SUMS: cannot be opened"});
  fs::copy(testing::mesh_folder(), folder / "meshes");
  fs::remove(folder / "meshes/Mesh5.msh");
  expect_refusal("--check --meshes=meshes", 1, {"meshes/Mesh5.msh: cannot be opened"});
}

TEST_F(CatalogueCommand, RemakesIdenticalFiles) {
  if (const GmshSession session; gmsh_version() != catalogue_gmsh_version)
    GTEST_SKIP() << "another version of Gmsh makes other meshes";
  const Outcome outcome = run("--mesh='Mesh0..Mesh1,Mesh[01]' --out=new");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  std::string expected;
  for (const std::string name : {"Mesh0", "Mesh1"}) {
    const fs::path file = testing::mesh_file(name);
    expected += name + "  " + sha256_of_file(file) + "  identical\n";
    EXPECT_EQ(sha256_of_file(folder / "new" / (name + ".msh")), sha256_of_file(file));
  }
  EXPECT_EQ(outcome.out, expected);
  EXPECT_EQ(exit_code_of("cd '" + (folder / "new").string() +
                         "' && sha256sum --status --strict -c SHA256SUMS"),
            0);
}

TEST_F(CatalogueCommand, RemakeNoticesADifferenceAndSaysTheVersions) {
  fs::create_directory(folder / "meshes");
  write_text(folder / "meshes/Mesh0.msh", "another mesh");
  const Outcome outcome = run("--mesh=Mesh0,Mesh1 --meshes=meshes");
  EXPECT_EQ(outcome.exit_code, 1);
  for (const char* part : {"  differs from meshes/Mesh0.msh\n", "  missing: meshes/Mesh1.msh\n",
                           "The catalogue was made with Gmsh 4.8.4; this library is Gmsh "})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  EXPECT_EQ(text_of(folder / "meshes/Mesh0.msh"), "another mesh");
}

}  // namespace
}  // namespace airybench::catalogue_command_test
