// Bounds are of the wall as it is, whatever lies between the points that a mesh has on it.
#include "bench/run/adaptive_loop.hpp"
#include "mesh/refinement.hpp"
#include "tests/bench/verify/solved.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::wall_bounds_test {
namespace {

// Pressed by 0.01 mm against what its right side faces.
Scene pressed(Wall wall, std::optional<Wall> face = {}) {
  return {.friction = 0,
          .crown_radius_mm = {},
          .wall = std::move(wall),
          .face = std::move(face),
          .displacement_mm = {0.01, 0}};
}

const FlatWall flat{{10, 0}, {-1, 0}};

// What no point of the coarse mesh knows.
std::vector<std::pair<std::string, Scene>> scenes() {
  const PolylineWall bump{{{10, -2}, {10, 2.4}, {9.99, 2.5}, {10, 2.6}, {10, 12}}},
      step{{{10, -2}, {10, 4.1}, {10.05, 4.1}, {10.05, 12}}},
      hollow{{{10, -2}, {10, 3.6}, {10.02, 4}, {10, 4.4}, {10, 12}}};
  PolylineWall waves;
  for (int k = -2; k < 60; ++k)
    waves.points_mm.emplace_back(10 + (k % 2 == 0 ? 0 : 0.004), 0.2 * k);
  return {{"bump", pressed(bump)},
          {"bump of the face",
           pressed(flat, PolylineWall{{{10, -2}, {10, 2.4}, {10.01, 2.5}, {10, 2.6}, {10, 12}}})},
          {"step", pressed(step)},
          {"hollow", pressed(hollow)},
          {"waves", pressed(waves)}};
}

TEST(WallBounds, DoNotCrossThoseOfFinerMeshes) {
  for (const auto& [name, scene] : scenes()) {
    Mesh mesh = testing::small_block(3, 3, 0);
    double below = 0, above = std::numeric_limits<double>::infinity();
    for (int level = 0; level < 5; ++level) {
      if (level > 0) mesh = uniformly_refined(mesh);
      const ConstitutiveError error = testing::Solved(scene, mesh).error();
      ASSERT_TRUE(error.guaranteed) << name << " " << level << ": " << error.flaw;
      below = std::max(below, error.lower_bound_Nmm);
      above = std::min(above, error.upper_bound_Nmm);
      EXPECT_LT(below, above) << name << " " << level;
    }
  }
}

TEST(WallBounds, AdaptingFindsTheBump) {
  const Scene scene = scenes().front().second;
  AdaptiveSettings settings;
  settings.goals = {AdaptGoal{.error = 0.05, .unknowns = {}}};
  AdaptiveLoop loop(scene, testing::small_block(3, 3, 0), select_methods("HYBRID").front(),
                    settings);
  std::optional<AdaptiveLevel> last;
  while (std::optional<AdaptiveLevel> level = loop.next()) last = std::move(level);
  ASSERT_TRUE(loop.reached()) << loop.why_ended();
  double nearest = 1;
  for (const Eigen::Vector2d& x : last->mesh.vertices)
    nearest = std::min(nearest, (x - Eigen::Vector2d(10, 2.5)).norm());
  EXPECT_LT(nearest, 0.05);
}

TEST(WallBounds, AWallThatEndsInsideAnEdgeGuaranteesNothingAndIsMarked) {
  const Scene scene = pressed(PolylineWall{{{10, -2}, {10, 4.6}}});
  Mesh mesh = testing::small_block(3, 3, 0);
  double before = std::numeric_limits<double>::infinity();
  for (int level = 0; level < 3; ++level) {
    if (level > 0) mesh = uniformly_refined(uniformly_refined(mesh));
    const ConstitutiveError error = testing::Solved(scene, mesh).error();
    EXPECT_FALSE(error.guaranteed) << level;
    EXPECT_GT(error.beyond_wall_Nmm, 0) << level;
    EXPECT_LT(error.beyond_wall_Nmm, before) << level;
    before = error.beyond_wall_Nmm;
  }
}

}  // namespace
}  // namespace airybench::wall_bounds_test
