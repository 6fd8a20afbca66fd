// What holds a body and what does not, against closed forms of rigid bodies with Coulomb's law: on
// slopes, in grooves and slots, towers.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/held_scenes.hpp"
#include "tests/support/pieces.hpp"

namespace airybench::held_bodies_test {
namespace {

using Eigen::Vector2d;
using testing::add_block;
using testing::everywhere;
using testing::expect_breakdown;
using testing::expect_ok;
using testing::solved_scene;
using testing::turned;
using testing::turned_floor;
using testing::weighing;

// A block of 16 N/mm on a slope of 20° to the right, or so many of them, one on another.
Mesh blocks_on_slope(int count, int cells) {
  Mesh mesh;
  mesh.name = "slope";
  for (int k = 0; k < count; ++k) {
    const std::string name = std::string(1, static_cast<char>('a' + k));
    add_block(mesh, name, {0, 4 * k}, {4, 4 * k + 4}, cells, cells + k,
              {"contact:below_" + name, "force", k + 1 < count ? "contact:above_" + name : "force",
               "force"});
  }
  return turned(std::move(mesh), -20);
}

// W (sin 20° − μ cos 20°) is left.
TEST(HeldBodies, ABlockSlidesDownASlope) {
  Scene scene = weighing(1);
  scene.wall = turned_floor(-20);
  for (const auto& [friction, left] :
       {std::pair(0.2, "2.47"), {0.3, "0.962"}, {0.35, "0.21"}, {0., "5.47"}}) {
    scene.friction = friction;
    for (const int cells : {3, 7})
      expect_breakdown(
          scene, blocks_on_slope(1, cells),
          {"the body a: it slides along (0.94, -0.342)", "with " + std::string(left) + " N of"});
  }
  scene.friction = 0.4;
  expect_ok(scene, blocks_on_slope(1, 4), {"HYBRID", "HYBRID:k=3", "P2"});
}

TEST(HeldBodies, BodiesThatSlideTogetherAreNamedTogether) {
  Scene scene = weighing(1);
  scene.boundary["contact:below_a"].contact.wall = turned_floor(-20);
  scene.contacts = {{.between = {{{"contact:below_b"}, {"contact:above_a"}}}}};
  scene.boundary["contact:below_a"].contact.friction = 0.2;
  scene.contacts[0].friction = 1;
  expect_breakdown(scene, blocks_on_slope(2, 4),
                   {"the body a and the body b: they slide along (0.94, -0.342)", "with 4.93 N of"},
                   {"HYBRID", "P2"});
  scene.boundary["contact:below_a"].contact.friction = 0.5;
  scene.contacts[0].friction = 0.3;
  expect_breakdown(scene, blocks_on_slope(2, 4),
                   {"the body b: it slides along (0.94, -0.342)", "with 0.962 N of"},
                   {"HYBRID", "HYBRID:k=2", "P3"});
}

// A square on its corner in a groove of 90°, μ = 0.2. Along the right face (10 − 6 − 0.2·16)/√2 N
// is left of the load (10, −6), and (6 + 1)/√2·… of others.
TEST(HeldBodies, AWedgeLeavesItsGroove) {
  Mesh mesh;
  mesh.name = "groove";
  add_block(mesh, "wedge", {0, 0}, {4, 4}, 5, 5,
            {"contact:right", "force", "force", "contact:left"});
  mesh = turned(std::move(mesh), 45);
  Scene scene = weighing(0);
  scene.friction = 0.2;
  scene.boundary["contact:right"].contact.wall = turned_floor(45);
  scene.boundary["contact:left"].contact.wall = turned_floor(-45);
  const auto load = [&](double x, double y) {
    scene.body_force_N_per_mm3 = Vector2d(x, y) / 16;
    return scene;
  };
  expect_breakdown(load(10, -6), mesh,
                   {"the body wedge: it slides along (0.707, 0.707)", "with 0.566 N of"});
  expect_breakdown(load(-10, -6), mesh,
                   {"the body wedge: it slides along (-0.707, 0.707)", "with 0.566 N of"});
  expect_breakdown(load(0, 3), mesh,
                   {"the body wedge: it leaves contact along (0, 1)", "with 3 N of"});
  expect_ok(load(6, -6), mesh, {"HYBRID", "HYBRID:k=2", "P2"});
}

// A block of 4 × 4 on a held base, pressed and pushed on its top.
Mesh tower(int cells) {
  Mesh mesh;
  mesh.name = "tower";
  add_block(mesh, "base", {-6, -3}, {6, 0}, 3 * cells, 3,
            {"displacement", "force", "contact:base", "force"});
  add_block(mesh, "block", {-2, 0}, {2, 4}, cells, cells,
            {"contact:block", "force", "force:top", "force"});
  return mesh;
}

Scene pushed(double along_MPa) {
  Scene scene = weighing(0);
  scene.friction = 1;
  scene.contacts = {{.between = {{{"contact:block"}, {"contact:base"}}}}};
  scene.boundary["force:top"].traction_MPa = everywhere({along_MPa, -10});
  return scene;
}

// The resultant, 40 N downwards, is 0.4 mm to the right of the middle per MPa.
TEST(HeldBodies, ATowerTipsAboutTheEndOfItsFace) {
  for (const int cells : {4, 7}) {
    expect_breakdown(pushed(6), tower(cells),
                     {"the body block: it tips about (2, 0)", "with 16 N mm of"});
    expect_breakdown(pushed(-5.05), tower(cells),
                     {"the body block: it tips about (-2, 0)", "with 0.8 N mm of"});
  }
  expect_ok(pushed(4), tower(4), {"HYBRID", "HYBRID:k=2", "HYBRID:k=3", "3STEPD", "P2", "P3"});
}

// Pressures of degree k reach to 1/(k + 2) of an edge from its end.
TEST(HeldBodies, AMeshMayBeTooCoarseToTellThatATowerStands) {
  const auto expect_too_coarse = [](const Mesh& mesh, const char* name, const std::string& needed) {
    expect_breakdown(pushed(4.8), mesh,
                     {"too coarse to decide", "At (2, 0) ", "0.08 mm from the end of the face",
                      "at most " + needed + " mm there, not 1 mm"},
                     {name});
  };
  for (const auto& [name, needed] : {std::pair("HYBRID", "0.24"),
                                     {"3STEPD", "0.24"},
                                     {"HYBRID:k=2", "0.32"},
                                     {"HYBRID:k=3", "0.4"}})
    expect_too_coarse(tower(4), name, needed);
  Mesh in_another_order = tower(4);  // of two pairs of edges the block's is first now
  std::ranges::rotate(in_another_order.boundary, in_another_order.boundary.end() - 12);
  expect_too_coarse(in_another_order, "HYBRID", "0.24");
  expect_ok(pushed(4.8), tower(4), {"P2", "P3"});
  expect_ok(pushed(4.8), tower(20), {"HYBRID"});
}

// Walls at a distance on both sides do not hold it by friction, though without gap they could.
TEST(HeldBodies, ASlotWithClearanceHoldsNothing) {
  Mesh mesh;
  mesh.name = "slot";
  add_block(mesh, "key", {-2, 0}, {2, 4}, 4, 4,
            {"force", "contact:right", "force", "contact:left"});
  Scene scene = weighing(1);
  scene.friction = 0.8;
  scene.boundary["contact:right"].contact.wall = FlatWall{{2.01, 0}, {-1, 0}};
  scene.boundary["contact:left"].contact.wall = FlatWall{{-2.02, 0}, {1, 0}};
  expect_breakdown(scene, mesh, {"the body key: it slides along (0, -1)", "with 16 N of"},
                   {"HYBRID", "P2"});
}

// An overlap presses it between two jaws, and friction there carries a part of its weight, of which
// rigid bodies know nothing.
TEST(HeldBodies, WhatIsClampedTooLittleSlides) {
  Mesh mesh;
  mesh.name = "clamp";
  add_block(mesh, "left", {-5, 0}, {-2, 4}, 3, 4,
            {"force", "contact:left", "force", "displacement"});
  add_block(mesh, "key", {-2, 0}, {2, 4}, 4, 4, {"force", "contact:b", "force", "contact:a"});
  add_block(mesh, "right", {2, 0}, {5, 4}, 3, 4,
            {"force", "displacement", "force", "contact:right"});
  Scene scene = weighing(1);
  scene.contacts = {{.between = {{{"contact:a"}, {"contact:left"}}}, .clearance_mm = -0.002},
                    {.between = {{{"contact:b"}, {"contact:right"}}}, .clearance_mm = -0.002}};
  const auto left_N = [&](const char* name, double friction) {
    scene.friction = friction;
    const std::string message = solved_scene(scene, mesh, name).message,
                      clamped =
                          "; contact forces that prescribed displacements or overlaps make "
                          "leave ";
    EXPECT_TRUE(
        message.starts_with("nothing holds the body key: it slides along (0, -1), with 16 "
                            "N of its loads unbalanced"))
        << message;
    const auto at = message.find(clamped);
    return at == std::string::npos ? 16 : std::stod(message.substr(at + clamped.size()));
  };
  for (const char* name : {"HYBRID", "HYBRID:k=2", "P2"}) {
    EXPECT_EQ(left_N(name, 0), 16) << name;
    const double once = left_N(name, 0.003), twice = left_N(name, 0.006);
    EXPECT_GT(twice, 0) << name;
    EXPECT_NEAR(16 - twice, 2 * (16 - once), 0.05 * (16 - twice)) << name;
    scene.friction = 0.1;
    expect_ok(scene, mesh, {name});
  }
}

TEST(HeldBodies, TheStepThatIsNotHeldIsNamed) {
  Scene scene = weighing(1);
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.friction = 0.3;
  Mesh mesh;
  mesh.name = "path";
  add_block(mesh, "block", {0, 0}, {8, 4}, 8, 4, {"contact", "force", "force:top", "force"});
  LoadStep step;
  for (const double along : {0.5, 2.}) {
    step.boundary["force:top"].traction_MPa = everywhere({along, 0});
    scene.later_steps.push_back(step);
  }
  for (const char* name : {"HYBRID", "3STEPD", "P2"}) {
    int steps = 0;
    const Solution last = solve_load_steps(
        select_methods(name).front(), testing::posed(scene, mesh), {},
        [&](int, const ContactSystem&, const Solution& answer) {
          EXPECT_EQ(answer.status, steps < 2 ? Status::ok : Status::breakdown) << answer.message;
          ++steps;
        });
    EXPECT_EQ(steps, 3) << name;
    // 16 − 0.3·32 N
    testing::expect_named(last.message,
                          {"the body block: it slides along (1, 0)", "with 6.4 N of"});
  }
}

}  // namespace
}  // namespace airybench::held_bodies_test
