// A semicircular arch of 25 stones under its weight: held by contact alone, by friction at every
// joint.
//
// The least friction at which rigid stones stand is that of limit analysis: a linear program over
// each joint's normal forces at its two ends and the tangential one between, |T| ≤ μ N, in
// equilibrium with the weight of the polygons below. Solved once, to 1e-10.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"

namespace airybench::arch_test {
namespace {

constexpr int stones = 25;
constexpr double radius_mm = 10;  // in the middle

// Stresses carry a load to a third of an edge from the end of a joint, which has so many.
Mesh arch(double thickness_mm, int edges) {
  Mesh mesh;
  mesh.name = "arch";
  std::vector<double> radii;
  for (int i = 0; i <= edges; ++i)
    radii.push_back(radius_mm + (static_cast<double>(i) / edges - 0.5) * thickness_mm);
  for (int k = 0; k < stones; ++k)
    testing::add_ring_sector(
        mesh, fmt::format("stone {}", k), radii, 2, "force", "force",
        {{std::numbers::pi * k / stones, std::numbers::pi * (k + 1) / stones},
         {fmt::format("contact:{} first", k), fmt::format("contact:{} last", k)}});
  validate(mesh);
  return mesh;
}

Scene under_its_weight(double friction) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.friction = friction;
  scene.displacement_mm = {0, 0};
  scene.body_force_N_per_mm3 = {0, -2.5e-5};
  for (int k = 0; k + 1 < stones; ++k)
    scene.contacts.push_back({.between = {{{fmt::format("contact:{} last", k)},
                                           {fmt::format("contact:{} first", k + 1)}}}});
  for (const std::string& springing :
       {std::string("contact:0 first"), fmt::format("contact:{} last", stones - 1)})
    scene.boundary[springing].contact.wall = FlatWall{{0, 0}, {0, 1}};
  return scene;
}

TEST(Arch, StandsFromTheFrictionOfLimitAnalysisOn) {
  constexpr double least = 0.3076886206;
  const Mesh mesh = arch(2.5, 4);
  const Method method = select_methods("HYBRID").front();
  for (const double friction : {0.5, 1.02 * least, 0.98 * least}) {
    const Solution solution = solve_load_case(
        method.solve, *assemble(method, testing::posed(under_its_weight(friction), mesh)), {});
    if (friction > least) {
      EXPECT_EQ(solution.status, Status::ok) << friction << ": " << solution.message;
    } else {
      EXPECT_EQ(solution.status, Status::breakdown) << friction;
      EXPECT_NE(solution.message.find("nothing holds"), std::string::npos) << solution.message;
    }
  }
}

}  // namespace
}  // namespace airybench::arch_test
