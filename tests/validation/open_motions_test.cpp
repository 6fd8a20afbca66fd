// Motions that no contact resists, along rollers and faces without friction, and bodies without
// loads.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/rigid_contact.hpp"
#include "solvers/contact/condensed.hpp"
#include "tests/support/held_scenes.hpp"
#include "tests/support/pieces.hpp"

namespace airybench::open_motions_test {
namespace {

using testing::add_block;
using testing::everywhere;
using testing::expect_breakdown;
using testing::expect_ok;
using testing::weighing;

constexpr double shortened = 0.01;

// Two blocks without friction between them, sides free, on rollers below and above.
Mesh two_springs() {
  Mesh mesh;
  mesh.name = "springs";
  add_block(mesh, "low", {0, 0}, {8, 4}, 9, 5,
            {"displacement:base", "force", "contact:low", "force:low"});
  add_block(mesh, "up", {0, 4}, {8, 7}, 13, 5,
            {"contact:up", "force:up", "displacement:head", "force"});
  return mesh;
}

Scene pressed_springs() {
  Scene scene = weighing(0);
  scene.friction = 0;
  scene.materials = {{"low", {200000, 0.25}}, {"up", {70000, 0.3}}};
  scene.contacts = {{.between = {{{"contact:low"}, {"contact:up"}}}}};
  for (const char* rolls : {"displacement:base", "displacement:head"})
    scene.boundary[rolls].support = BoundaryValues::Support::normal;
  scene.boundary["displacement:head"].displacement_mm = everywhere({0, -shortened});
  return scene;
}

const std::vector<const char*> all_kinds = {"HYBRID", "HYBRID:k=2", "HYBRID:k=3", "HYBRID:MUMPS",
                                            "3STEPD", "3STEPCG3",   "BLIND",      "BLIND:SCHUR",
                                            "P2",     "P3",         "P4"};

void expect_uniform_stress(const Scene& scene, const Mesh& mesh, double yy_MPa) {
  for (const char* name : all_kinds) {
    const Solution answer = testing::solved_scene(scene, mesh, name);
    EXPECT_EQ(answer.status, Status::ok) << name << ": " << answer.message;
    double error = 0;
    for (int t = 0; t < static_cast<int>(answer.stress.size()); ++t)
      error = std::max(
          error,
          (answer.stress[t].colwise() - Eigen::Vector3d(0, yy_MPa, 0)).cwiseAbs().maxCoeff());
    EXPECT_LT(error, 1e-6 * std::abs(yy_MPa)) << name;
    EXPECT_LT(answer.free_motion_mm.norm(), 1e-9) << name;
  }
}

// σ = −u / Σ h (1 − ν²)/E.
TEST(OpenMotions, WhatMaySlideFreelyHasTheStressOfSprings) {
  const double compliance = 4 * (1 - 0.25 * 0.25) / 200000 + 3 * (1 - 0.3 * 0.3) / 70000;
  expect_uniform_stress(pressed_springs(), two_springs(), -shortened / compliance);
  const auto problem = testing::posed(pressed_springs(), two_springs());
  EXPECT_EQ(words_of_open_motions(rigid_contact(*problem)),
            "no contact resists, and no load moves, the body low along (1, 0), the body up along "
            "(1, 0)");
}

TEST(OpenMotions, OneThatMaySlideAlongAWallIsPressedUniformly) {
  Mesh mesh;
  mesh.name = "alone";
  add_block(mesh, "block", {0, 0}, {8, 4}, 9, 5, {"contact", "force", "displacement", "force"});
  Scene scene = weighing(0);
  scene.friction = 0;
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;
  scene.boundary["displacement"].displacement_mm = everywhere({0, -shortened});
  const double stiffness = 210000 / (1 - 0.3 * 0.3) / 4;
  expect_uniform_stress(scene, mesh, -shortened * stiffness);
}

// However small; opposite loads that cancel are none.
TEST(OpenMotions, ALoadAlongAnOpenMotionIsNamed) {
  Scene scene = pressed_springs();
  scene.boundary["force:up"].traction_MPa = everywhere({-0.01, 0});
  expect_breakdown(scene, two_springs(), {"the body up: it slides along (-1, 0)", "with 0.03 N of"},
                   {"HYBRID", "HYBRID:k=2", "3STEPD", "BLIND:SCHUR", "P2"});
}

// The upper block is joined to the middle one by friction: both are open as one.
TEST(OpenMotions, BodiesJoinedByFrictionMaySlideTogether) {
  Mesh mesh;
  mesh.name = "pile";
  add_block(mesh, "low", {0, -4}, {8, 0}, 8, 4, {"displacement", "force", "contact:low", "force"});
  add_block(mesh, "middle", {2, 0}, {6, 3}, 5, 3,
            {"contact:middle", "force", "contact:over", "force:middle"});
  add_block(mesh, "high", {3, 3}, {5, 5}, 3, 3, {"contact:high", "force:high", "force", "force"});
  Scene scene = weighing(1);
  scene.contacts = {{.between = {{{"contact:low"}, {"contact:middle"}}}, .friction = 0},
                    {.between = {{{"contact:over"}, {"contact:high"}}}, .friction = 0.5}};
  expect_ok(scene, mesh, {"HYBRID", "HYBRID:k=2", "3STEPD", "BLIND:SCHUR", "P2", "P3"});
  EXPECT_EQ(words_of_open_motions(rigid_contact(*testing::posed(scene, mesh))),
            "no contact resists, and no load moves, the body middle along (1, 0), the body high "
            "along (1, 0)");
  // The middle pushes the upper block back: held against each other, 0.3 N on both is balanced.
  scene.boundary["force:middle"].traction_MPa = everywhere({0.1, 0});
  scene.boundary["force:high"].traction_MPa = everywhere({-0.15, 0});
  expect_ok(scene, mesh, {"HYBRID", "P2"});
  scene.boundary["force:high"].traction_MPa = everywhere({-0.1, 0});
  expect_breakdown(scene, mesh,
                   {"the body middle and the body high: they slide along (1, 0)", "with 0.1 N of"},
                   {"HYBRID", "P2"});
}

// Without loads contact forces are rounding; so is what they leave.
TEST(OpenMotions, ABodyWithoutLoadsStaysWhereItIs) {
  Mesh mesh;
  mesh.name = "idle";
  add_block(mesh, "block", {0, 0}, {8, 4}, 9, 5, {"contact", "force", "force:top", "force"});
  Scene scene = weighing(0);
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  for (const double friction : {0., 0.3})
    for (const double poisson : {0., 0.3}) {
      scene.friction = friction;
      scene.material.poisson = poisson;
      expect_ok(scene, mesh, {"HYBRID", "HYBRID:k=2", "3STEPD", "BLIND:SCHUR", "P2", "P3"});
    }
}

TEST(OpenMotions, WhatIsNoNumberIsABreakdown) {
  for (const ContactSolver solver : {ContactSolver::newton, ContactSolver::gauss_seidel,
                                     ContactSolver::anderson, ContactSolver::admm}) {
    contact::Problem problem;
    problem.D = Eigen::MatrixXd::Identity(4, 4);
    problem.G = Eigen::VectorXd::Constant(4, std::nan(""));
    problem.points.count = 2;
    problem.points.friction = {0.3, 0.3};
    RunControl control;
    control.contact.solver = solver;
    Solution solution;
    solve_condensed_contact(problem, control, solution);
    EXPECT_EQ(solution.status, Status::breakdown);
    testing::expect_named(solution.message, {"contact law"});
  }
}

}  // namespace
}  // namespace airybench::open_motions_test
