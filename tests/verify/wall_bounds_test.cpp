// Bounds are of the wall as it is, whatever lies between the points that a mesh has on it: that
// they hold on walls at random is RandomBounds'.
#include "bench/run/adaptive_loop.hpp"
#include "mesh/refinement.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"

namespace airybench::wall_bounds_test {
namespace {

// A block pressed by 0.01 mm against what its right side faces.
Scene pressed(PolylineWall wall) {
  return {
      .friction = 0, .crown_radius_mm = {}, .wall = std::move(wall), .displacement_mm = {0.01, 0}};
}

TEST(WallBounds, AdaptingFindsTheBump) {
  // No point of the coarse mesh knows the bump.
  const Scene scene =
      pressed(PolylineWall{{{10, -2}, {10, 2.4}, {9.99, 2.5}, {10, 2.6}, {10, 12}}});
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
