#include "assembly/problem/pose.hpp"

#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::scene_test {
namespace {

using testing::small_tooth;

std::string complaint(const Scene& scene, const Mesh& mesh) {
  return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
}

TEST(Scene, CrownIsCentredOnEachToothsAxis) {
  for (const Mesh& mesh : {small_tooth(4, 4), testing::catalogue_mesh("Mesh4")}) {
    const Problem problem = pose({}, mesh);
    const auto faces = boundary_chains(problem.mesh, BoundaryRole::contact);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const double axis = faces.size() == 1 ? 0 : 6.25 + 12.5 * static_cast<double>(k);
      const int row = faces[k].front();
      EXPECT_NEAR(problem.loads.gap_mm({10, axis}, row), 0, 1e-12);
      EXPECT_NEAR(problem.loads.gap_mm({10, axis - 3}, row), 9 / 800., 1e-9);
      // The face's own axis, however near another one is.
      EXPECT_NEAR(problem.loads.gap_mm({10, axis + 12.5}, row), 12.5 * 12.5 / 800., 1e-9);
    }
  }
}

TEST(Scene, EachLoadStepKeepsWhatItDoesNotSay) {
  Scene scene;
  scene.displacement_mm = {0.02, 0};
  scene.boundary["force"].traction_MPa = LinearValue<Eigen::Vector2d>{{{{1, 2}, {1, 2}}}};
  scene.later_steps.resize(3);
  scene.later_steps[0].displacement_mm = Eigen::Vector2d(0.03, 0.01);
  scene.later_steps[1].boundary["force"].pressure_MPa = LinearValue<double>{{3, 3}};
  scene.later_steps[1].clearance_mm = 0.5;
  scene.later_steps[2].body_force_N_per_mm3 = Eigen::Vector2d(4, 5);
  const Problem problem = pose(scene, small_tooth(4, 4));
  ASSERT_EQ(problem.later_steps.size(), 3u);
  const auto row_of = [&](BoundaryRole role) {
    int row = 0;
    while (problem.mesh.boundary[row].role != role) ++row;
    return row;
  };
  const int moved = row_of(BoundaryRole::displacement), pulled = row_of(BoundaryRole::force),
            touching = row_of(BoundaryRole::contact);
  const Eigen::Vector2d x(10, 0), n(0, 1), traction(1, 2), pressure(0, -3), there(0.03, 0.01);
  for (const Loads& step : problem.later_steps) EXPECT_EQ(step.displacement_mm(x, moved), there);
  EXPECT_EQ(problem.later_steps[0].traction_MPa(x, n, pulled), traction);
  EXPECT_EQ(problem.later_steps[1].traction_MPa(x, n, pulled), pressure);
  EXPECT_EQ(problem.later_steps[2].traction_MPa(x, n, pulled), pressure);
  EXPECT_EQ(problem.later_steps[0].gap_mm(x, touching), problem.loads.gap_mm(x, touching));
  EXPECT_EQ(problem.later_steps[2].gap_mm(x, touching), problem.loads.gap_mm(x, touching) + 0.5);
  EXPECT_FALSE(problem.later_steps[1].has_body_force());
  EXPECT_EQ(problem.later_steps[2].body_force_N_per_mm3, Eigen::Vector2d(4, 5));
}

TEST(Scene, EqualStepsEndWhereTheSceneIs) {
  Scene scene;
  scene.body_force_N_per_mm3 = {3, 0};
  scene.boundary["force"].pressure_MPa = LinearValue<double>{{6, 6}};
  scene.equal_steps = 3;
  const Problem problem = pose(scene, small_tooth(4, 4));
  ASSERT_EQ(problem.later_steps.size(), 2u);
  EXPECT_EQ(problem.loads.body_force_N_per_mm3, Eigen::Vector2d(1, 0));
  EXPECT_EQ(problem.later_steps[0].body_force_N_per_mm3, Eigen::Vector2d(2, 0));
  EXPECT_EQ(problem.later_steps[1].body_force_N_per_mm3, Eigen::Vector2d(3, 0));
  int row = 0;
  while (problem.mesh.boundary[row].role != BoundaryRole::force) ++row;
  EXPECT_NEAR(problem.later_steps[0].traction_MPa({0, 0}, {0, 1}, row).y(), -4, 1e-15);
  row = 0;
  while (problem.mesh.boundary[row].role != BoundaryRole::contact) ++row;
  EXPECT_EQ(problem.loads.gap_mm({10, 2}, row), problem.later_steps[1].gap_mm({10, 2}, row));
}

TEST(Scene, GeometryThatTheMeshHasIsAccepted) {
  Scene scene;
  scene.root_half_height_mm = 5;
  scene.length_mm = 10;
  scene.tip_half_height_mm = 3;
  scene.teeth = 1;
  EXPECT_EQ(complaint(scene, small_tooth(4, 4)), "no complaint");
  scene.teeth = 4;
  EXPECT_EQ(complaint(scene, testing::catalogue_mesh("Mesh4")), "no complaint");
}

TEST(Scene, ContradictionsAndImpossibleValuesAreNamed) {
  struct Case {
    std::function<void(Scene&)> change;
    std::vector<std::string> named;
  };
  using V2 = Eigen::Vector2d;
  for (const auto& [change, named] : std::vector<Case>{
           {[](Scene& s) { s.teeth = 4; }, {"teeth: 4", "1 contact face"}},
           {[](Scene& s) { s.length_mm = 11; }, {"length_mm: 11", "10"}},
           {[](Scene& s) { s.root_half_height_mm = 4; }, {"root_half_height_mm: 4", "5"}},
           {[](Scene& s) { s.tip_half_height_mm = 2; }, {"tip_half_height_mm: 2", "3"}},
           {[](Scene& s) { s.material.poisson = 0.5; }, {"poisson: 0.5"}},
           {[](Scene& s) { s.material.young_MPa = 0; }, {"young_MPa: 0"}},
           {[](Scene& s) { s.material.young_MPa = 2.1e-303; }, {"young_MPa: 2.1e-303"}},
           {[](Scene& s) { s.friction = -0.1; }, {"friction: -0.1"}},
           {[](Scene& s) { s.friction = 1e308; }, {"friction: 1e+308"}},
           {[](Scene& s) { s.boundary["contact"].contact.friction = 1e308; },
            {"boundary: contact: friction: 1e+308"}},
           {[](Scene& s) { s.displacement_mm = V2(1e-200, 0); }, {"loads: forces of about "}},
           {[](Scene& s) { s.displacement_mm = V2(0, -2e15); }, {"displacement_mm: [0, -2e+15]"}},
           {[](Scene& s) { s.displacement_mm.x() = std::nan(""); },
            {"displacement_mm: [nan, 0.006]"}},
           {[](Scene& s) { s.crown_radius_mm = 1e300; }, {"crown_radius_mm: 1e+300"}},
           {[](Scene& s) { s.crown_radius_mm = -1; }, {"crown_radius_mm: -1"}},
           {[](Scene& s) { s.clearance_mm = 1e300; }, {"clearance_mm: 1e+300"}},
           {[](Scene& s) { s.clearance_mm = -1; }, {"clearance_mm: -1"}},
           {[](Scene& s) { s.body_force_N_per_mm3 = V2(1e31, 0); },
            {"body_force_N_per_mm3: [1e+31, 0]"}},
           {[](Scene& s) {
              s.boundary["force"].pressure_MPa = LinearValue<double>{{1, 1e31}};
            },
            {"boundary: force: pressure_MPa: 1e+31"}},
           {[](Scene& s) {
              s.materials["rubber"] = Material{1, 0.3};
            },
            {"materials: rubber", "its bodies: body"}},
           {[](Scene& s) { s.mesh.keep_contact_edges = 9; }, {"mesh: keep_contact_edges: 9", "4"}},
           {[](Scene& s) { s.layers.normal.setZero(); }, {"layers: normal: [0, 0]"}},
       }) {
    Scene scene;
    change(scene);
    const std::string what = complaint(scene, small_tooth(4, 4));
    EXPECT_TRUE(what.starts_with("default scene: ")) << what;
    testing::expect_named(what, named);
  }
}

TEST(Scene, ACrownNeedsStraightFaces) {
  Mesh mesh = testing::small_block(4, 4, 30);
  for (BoundaryEdge& edge : mesh.boundary)
    if (boundary_label(mesh, edge) == "force:top")
      edge = {edge.vertices, BoundaryRole::contact, boundary_group(mesh, "top")};
  testing::expect_named(complaint(Scene(), mesh), {"crown_radius_mm: 400", "face is bent"});
  Scene flat;
  flat.crown_radius_mm.reset();
  EXPECT_EQ(complaint(flat, mesh), "no complaint");
}

TEST(Scene, EveryBodyCanHaveItsMaterial) {
  Mesh mesh = small_tooth(4, 4);
  mesh.body_names = {"root", "tip"};
  for (std::size_t t = 16; t < mesh.triangles.size(); ++t) mesh.triangle_body[t] = 1;
  Scene scene;
  scene.materials["tip"] = {70000, 0.33};
  const Problem problem = pose(scene, mesh);
  EXPECT_EQ(problem.compliance_of(0), compliance({210000, 0.3}, Plane::strain));
  EXPECT_EQ(problem.compliance_of(20), compliance({70000, 0.33}, Plane::strain));
}

TEST(Scene, TheMeshIsTransformedFirst) {
  Scene scene;
  scene.mesh.refine = 1;
  scene.mesh.scale = 10;
  scene.length_mm = 100;  // of the transformed mesh
  const Problem problem = pose(scene, small_tooth(4, 4));
  EXPECT_EQ(problem.mesh.triangles.size(), 128u);
  EXPECT_EQ(problem.mesh.name, "small tooth");
  scene.length_mm = 10;
  testing::expect_named(complaint(scene, small_tooth(4, 4)), {"length_mm: 10 ", "which has 100"});
}

TEST(Scene, LayersTakeTheirMaterialsInTurnAndNamedOnesTheirOwn) {
  Scene scene;
  scene.layers.count = 4;
  scene.layer_materials = {{1000, 0.1}, {2000, 0.2}};
  scene.materials["layer 3"] = {3000, 0.3};
  const Problem problem = pose(scene, small_tooth(8, 4));
  const Material expected[] = {{1000, 0.1}, {2000, 0.2}, {3000, 0.3}, {2000, 0.2}};
  ASSERT_EQ(problem.compliance.size(), 4u);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(problem.compliance[k], compliance(expected[k], Plane::strain));
}

}  // namespace
}  // namespace airybench::scene_test
