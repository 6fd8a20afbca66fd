// The scene files of the stability atlas.
#include <gtest/gtest.h>

#include "assembly/problem/pose.hpp"
#include "bench/plan/scene_file.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "verify/reference.hpp"

namespace airybench::stability_scenes_test {
namespace {

const std::filesystem::path folder = testing::stability_scenes_folder();

using testing::catalogue_mesh;

TEST(StabilityScenes, AllCanBeReadAndPosed) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    ASSERT_EQ(entry.path().extension(), ".json");
    const Scene scene = read_scene(entry.path());
    ++count;
    EXPECT_FALSE(scene.group.empty());
    EXPECT_TRUE(scene.about.ends_with("."));
    for (const char* mesh : {"Mesh0", "Mesh1"}) {
      const Problem problem = pose(scene, catalogue_mesh(mesh));
      EXPECT_NO_THROW(validate(problem.mesh));
      EXPECT_EQ(problem.mesh.name, mesh);
    }
  }
  EXPECT_GE(count, 40);
}

Reference reference_of(const std::string& scene) {
  return compute_reference(contact_system(
      testing::posed(read_scene(folder / (scene + ".json")), catalogue_mesh("Mesh0"))));
}

TEST(StabilityScenes, TheSameStateInOtherUnitsGivesTheSameForcesTimesAFactor) {
  const Eigen::VectorXd F = reference_of("default").F_C;
  // Forces follow E · displacement (thickness stays 1 mm): E u for one size.
  for (const auto& [scene, factor] : {std::pair{"scale_1e-6", 1e-6},
                                      {"scale_1e6", 1e6},
                                      {"load_1e-12", 1e-12},
                                      {"load_1e6", 1e6},
                                      {"young_1e-6", 1e-6 / 210000},
                                      {"young_1e12", 1e12 / 210000}})
    EXPECT_LE((reference_of(scene).F_C / factor - F).norm(), 1e-10 * F.norm()) << scene;
  // As far as coordinates are rounded.
  EXPECT_LE((reference_of("moved_1e3").F_C - F).norm(), 1e-10 * F.norm());
  EXPECT_LE((reference_of("moved_1e6").F_C - F).norm(), 1e-7 * F.norm());
}

}  // namespace
}  // namespace airybench::stability_scenes_test
