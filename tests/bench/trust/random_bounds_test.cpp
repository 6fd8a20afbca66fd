// The promise: where bounds are called guaranteed they hold, whatever the wall does between the
// points of a mesh, at every step of a path, up to ν = 0.4999, for stresses of every degree. Here
// on blocks at random, each on its mesh and refined: no lower bound of one is above an upper bound
// of another.
//
// AIRYBENCH_RANDOM_SCENES=FIRST,COUNT in the environment tries others, and more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "mesh/refinement.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/random_scenes.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::random_bounds_test {
namespace {

constexpr int scenes = testing::sanitized ? 4 : 60, refinements = testing::sanitized ? 1 : 2;

using testing::Dice;

// In front of the side x = 10 and beyond its ends, with features from a hundredth of an edge on;
// steps stand upright.
PolylineWall random_profile(Dice& dice) {
  const double rough = dice.below(3) == 0 ? 0 : dice.between(0.001, 0.02),
               features = dice.below(2) == 0 ? 0.05 : 1;
  PolylineWall wall{{{10, -3}}};
  for (double y = -2; y < 12; y += features * dice.between(0.5, 1.5)) {
    wall.points_mm.emplace_back(10 + rough * dice.between(-1, 1), y);
    if (dice.below(5) == 0) wall.points_mm.emplace_back(10 + rough * dice.between(-1, 1), y);
  }
  wall.points_mm.emplace_back(10, 13);
  std::erase_if(wall.points_mm, [last = Eigen::Vector2d(0, 0)](const Eigen::Vector2d& p) mutable {
    const bool again = p == last;
    last = p;
    return again;
  });
  return wall;
}

Scene random_scene(Dice& dice) {
  constexpr std::array<double, 6> poisson = {0, 0.3, 0.45, 0.49, 0.499, 0.4999};
  Scene scene;
  scene.material.poisson = poisson[static_cast<std::size_t>(dice.below(6))];
  scene.friction = 0;
  scene.crown_radius_mm.reset();
  scene.wall = random_profile(dice);
  scene.displacement_mm = {dice.between(0.002, 0.03), dice.between(-0.01, 0.01)};
  if (dice.below(3) == 0) scene.body_force_N_per_mm3 = {dice.between(-5, 5), dice.between(-5, 5)};
  scene.equal_steps = 1 + dice.below(3);
  if (dice.below(3) == 0) {
    scene.material.expansion_per_K = 12e-6;
    scene.temperature_K["body"] = {{dice.between(-200, 200), dice.between(-200, 200)},
                                   {Eigen::Vector2d(0, 0), Eigen::Vector2d(dice.between(1, 9), 5)}};
  }
  return scene;
}

struct Bounds {
  double below = -std::numeric_limits<double>::infinity(),
         above = std::numeric_limits<double>::infinity();
};

// A step's bounds on one mesh after the other.
void narrow(const Scene& scene, const Mesh& mesh, std::vector<Bounds>& of_step, int& guaranteed,
            int& judged) {
  solve_load_steps(select_methods("HYBRID").front(), testing::posed(scene, mesh), {},
                   [&](int step, const ContactSystem& system, const Solution& hybrid) {
                     ASSERT_EQ(hybrid.status, Status::ok) << hybrid.message;
                     const ConstitutiveError error = constitutive_error(
                         system, hybrid.stress, hybrid.F_C, recovered_displacement(system, hybrid));
                     EXPECT_EQ(error.flaw, "");
                     ++judged;
                     if (!error.guaranteed) return;
                     ++guaranteed;
                     Bounds& bounds = of_step[static_cast<std::size_t>(step)];
                     bounds.below = std::max(bounds.below, error.lower_bound_Nmm);
                     bounds.above = std::min(bounds.above, error.upper_bound_Nmm);
                   });
}

TEST(RandomBounds, OfOneMeshHoldForAnother) {
  const testing::Campaign wanted = testing::campaign(scenes);
  int judged = 0, guaranteed = 0;
  for (int k = wanted.first; k < wanted.first + wanted.count; ++k) {
    Dice dice(static_cast<std::uint32_t>(1000 + k));
    Mesh mesh = testing::small_block(2 + dice.below(3), 2 + dice.below(3), 0);
    const Scene scene = random_scene(dice);
    std::vector<Bounds> of_step(static_cast<std::size_t>(scene.equal_steps));
    for (int level = 0; level <= refinements; ++level) {
      if (level > 0) mesh = uniformly_refined(mesh);
      narrow(scene, mesh, of_step, guaranteed, judged);
      for (std::size_t step = 0; step < of_step.size(); ++step)
        EXPECT_LE(of_step[step].below, of_step[step].above)
            << "scene " << k << ", level " << level << ", step " << step + 1 << ", nu "
            << scene.material.poisson;
    }
  }
  std::cout << fmt::format("{} scenes, {} answers judged, {} with guaranteed bounds\n",
                           wanted.count, judged, guaranteed);
  EXPECT_EQ(guaranteed, judged);
}

// Of every degree, on one mesh refined once.
TEST(RandomBounds, OfOneDegreeHoldForAnother) {
  const testing::Campaign wanted = testing::campaign(testing::sanitized ? 2 : 20);
  for (int i = wanted.first; i < wanted.first + wanted.count; ++i) {
    Dice dice(static_cast<std::uint32_t>(5000 + i));
    Mesh mesh = dice.below(2) == 0 ? testing::small_block(2 + dice.below(2), 2 + dice.below(2), 0)
                                   : testing::small_tooth(2 + dice.below(2), 2 + dice.below(2));
    Scene scene = random_scene(dice);
    scene.equal_steps = 1;
    Bounds bounds;
    for (int level = 0; level < 2; ++level) {
      if (level > 0) mesh = uniformly_refined(mesh);
      for (int k = 1; k <= highest_stress_degree; ++k) {
        const ConstitutiveError error = testing::Solved(scene, mesh, k).error();
        EXPECT_EQ(error.flaw, "") << "scene " << i << ", level " << level << ", degree " << k;
        EXPECT_TRUE(error.guaranteed);
        bounds.below = std::max(bounds.below, error.lower_bound_Nmm);
        bounds.above = std::min(bounds.above, error.upper_bound_Nmm);
        EXPECT_LE(bounds.below, bounds.above) << "scene " << i << ", level " << level << ", degree "
                                              << k << ", nu " << scene.material.poisson;
      }
    }
  }
}

}  // namespace
}  // namespace airybench::random_bounds_test
