// Supports in points, which take out rigid motions of bodies whose loads balance.
#include <gtest/gtest.h>

#include "assembly/problem/pose.hpp"
#include "assembly/rigid_contact.hpp"
#include "assembly/total_displacement.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/held_scenes.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"

namespace airybench::point_supports_test {
namespace {

using Eigen::Vector2d;
using testing::add_block;
using testing::everywhere;
using testing::weighing;

const std::vector<const char*> all_kinds = {"HYBRID", "HYBRID:k=2", "HYBRID:k=3",  "HYBRID:MUMPS",
                                            "3STEPD", "3STEPCG3",   "BLIND:SCHUR", "P2",
                                            "P3",     "P4"};
constexpr double pulled_MPa = 100, young_MPa = 210000, poisson = 0.3;

Mesh bar(const testing::Sides& sides = {"force", "force:right", "force", "force:left"}) {
  Mesh mesh;
  mesh.name = "bar";
  add_block(mesh, "bar", {0, 0}, {8, 4}, 9, 5, sides);
  return mesh;
}

PointSupport point(const Vector2d& at_mm, std::optional<double> x_mm, std::optional<double> y_mm) {
  return {.at_mm = at_mm, .displacement_mm = {x_mm, y_mm}};
}

Scene pulled_bar(const std::vector<PointSupport>& points) {
  Scene scene = weighing(0);
  scene.material = {young_MPa, poisson};
  scene.boundary["force:right"].pressure_MPa = LinearValue<double>{{-pulled_MPa, -pulled_MPa}};
  scene.boundary["force:left"].pressure_MPa = LinearValue<double>{{-pulled_MPa, -pulled_MPa}};
  scene.point_supports = points;
  return scene;
}

// P's own, of HYBRID's stresses those that the judge recovers; none of the Airy function's.
DisplacementField displacement_of(const testing::SolvedScene& solved) {
  const auto w = displacement_of_answer(solved.system, solved.solution);
  return w ? with_rigid_motion(solved.problem(), *w) : DisplacementField();
}

// Pulled evenly along x, with these displacements.
void expect_stretched(const Scene& scene, const Mesh& mesh,
                      const std::function<Vector2d(const Vector2d&)>& u,
                      const std::vector<const char*>& methods) {
  for (const char* name : methods) {
    const testing::SolvedScene solved(scene, mesh, name);
    double stress_error = 0;
    for (int t = 0; t < static_cast<int>(solved.solution.stress.size()); ++t)
      stress_error = std::max(
          stress_error, (solved.solution.stress[t].colwise() - Eigen::Vector3d(pulled_MPa, 0, 0))
                            .cwiseAbs()
                            .maxCoeff());
    EXPECT_LT(stress_error, 1e-7 * pulled_MPa) << name;
    const DisplacementField found = displacement_of(solved);
    if (found.cols() == 0) continue;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      ASSERT_LT((found.col(static_cast<Eigen::Index>(v)) - u(mesh.vertices[v])).norm(), 1e-9)
          << name << " at " << mesh.vertices[v].transpose();
  }
}

Vector2d stretch(const Vector2d& x) {
  const double along = pulled_MPa * (1 - poisson * poisson) / young_MPa;
  return {along * x.x(), -along * poisson / (1 - poisson) * x.y()};
}

// Where three components are held does not change stresses; there displacements are as given.
TEST(PointSupports, ThreeComponentsHoldABodyWhoseLoadsBalance) {
  expect_stretched(pulled_bar({point({0, 0}, 0, 0), point({8, 0}, {}, 0)}), bar(), stretch,
                   all_kinds);
  const Vector2d middle(3.1, 1.7);  // within a triangle
  expect_stretched(
      pulled_bar({point(middle, 0.5, -0.25),
                  point({0, 4}, {}, -0.25 + stretch({0, 4}).y() - stretch(middle).y())}),
      bar(),
      [&](const Vector2d& x) -> Vector2d {
        return Vector2d(0.5, -0.25) + stretch(x) - stretch(middle);
      },
      {"HYBRID", "HYBRID:k=2", "P2", "P3"});
}

TEST(PointSupports, APointHoldsWhatRollersLeaveFree) {
  const Mesh mesh = bar({"displacement", "force:right", "force", "force:left"});
  Scene scene = pulled_bar({point({8, 4}, 0, {})});
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;
  expect_stretched(
      scene, mesh,
      [](const Vector2d& x) -> Vector2d {
        return stretch(x) - Vector2d(stretch({8, 4}).x(), 0);
      },
      all_kinds);
}

// Pressed on a wall without friction.
TEST(PointSupports, APointHoldsWhatContactLeavesFree) {
  const Mesh mesh = bar({"contact", "force", "force:top", "force"});
  for (const auto& [friction, held] : {std::pair(0., true), {0.3, false}}) {
    Scene scene = weighing(0);
    scene.wall = FlatWall{{0, 0}, {0, 1}};
    scene.friction = friction;
    scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{50, 50}};
    scene.point_supports = {point({0, 4}, 0.125, {})};
    if (!held) {
      testing::expect_breakdown(
          scene, mesh, {"the point support at (0, 4) holds what contact holds: it would carry"});
      continue;
    }
    for (const char* name : {"HYBRID", "HYBRID:k=2", "P2", "P3"}) {
      const testing::SolvedScene solved(scene, mesh, name);
      const DisplacementField u = displacement_of(solved);
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vector2d& x = mesh.vertices[v];
        const double along = 50 * poisson * (1 + poisson) / young_MPa;
        ASSERT_NEAR(u(0, static_cast<Eigen::Index>(v)), 0.125 + along * x.x(), 1e-9) << name;
      }
    }
    EXPECT_EQ(words_of_open_motions(rigid_contact(*testing::posed(scene, mesh))), "");
  }
}

TEST(PointSupports, LoadsThatTheyWouldCarryAreRefusedWithTheForces) {
  const std::vector<PointSupport> points = {point({0, 0}, 0, 0), point({8, 0}, {}, 0)};
  const auto named = [](const std::string& forces) {
    return std::vector<std::string>{"loads do not balance", " would carry " + forces + ","};
  };
  Scene scene = pulled_bar(points);
  scene.boundary["force:left"].pressure_MPa.reset();
  testing::expect_breakdown(
      scene, bar(), named("-400 N in x at (0, 0), -100 N in y at (0, 0), 100 N in y at (8, 0)"),
      all_kinds);
  scene = pulled_bar(points);
  scene.body_force_N_per_mm3 = {0, -0.5};
  testing::expect_breakdown(scene, bar(), named("8 N in y at (0, 0), 8 N in y at (8, 0)"));
  scene = pulled_bar(points);
  scene.boundary["force:right"].pressure_MPa->values.fill(-pulled_MPa * (1 + 1e-6));
  testing::expect_breakdown(
      scene, bar(),
      named("-0.0004 N in x at (0, 0), -0.0001 N in y at (0, 0), 0.0001 N in y at (8, 0)"));
  // In the last of a deck's eight digits they balance.
  scene.boundary["force:right"].pressure_MPa->values.fill(-pulled_MPa * (1 + 1e-9));
  testing::expect_ok(scene, bar(), all_kinds);
}

TEST(PointSupports, WhatIsHeldTwiceOrNotAtAllIsRefused) {
  const testing::Sides free = {"force", "force:right", "force", "force:left"},
                       on_rollers = {"displacement", "force:right", "force", "force:left"},
                       clamped = {"force", "force:right", "force", "displacement"};
  for (const auto& [sides, points, why] :
       std::vector<std::tuple<testing::Sides, std::vector<PointSupport>, std::string>>{
           {free, {point({0, 0}, 0, 0)}, "the body bar is free to move or turn"},
           {free, {point({0, 0}, 0, 0), point({8, 0}, 0, {})}, "[8, 0] holds x, which"},
           {free, {point({0, 0}, 0, 0), point({8, 0}, 0, 0)}, "[8, 0] holds x, which"},
           {free,
            {point({0, 0}, 0, 0), point({8, 0}, {}, 0), point({8, 4}, {}, 0)},
            "[8, 4] holds y, which"},
           {on_rollers, {point({8, 4}, 0, 0)}, "[8, 4] holds y, which"},
           {clamped, {point({8, 0}, {}, 0)}, "[8, 0] holds y, which"},
           {free, {point({0, 0}, {}, {})}, "[0, 0] holds nothing"},
           {free, {point({0, -1}, 0, 0)}, "[0, -1] lies off the mesh bar"},
           {free, {{{0, 0}, {0, 0}, "rod"}}, "[0, 0] of the body rod"},
       }) {
    Scene scene = pulled_bar(points);
    scene.boundary.clear();
    if (sides == on_rollers)
      scene.boundary["displacement"].support = BoundaryValues::Support::normal;
    testing::expect_named(
        testing::complaint_of<SceneError>([&, own = sides] { pose(scene, bar(own)); }),
        {"point_supports: " + why});
  }
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(pulled_bar({}), bar()); }),
                        {"mesh bar: no displacement and no contact edge", "point_supports"});
}

// Where two bodies touch, the point belongs to the one that it names.
TEST(PointSupports, APointOfTwoBodiesNamesOne) {
  Mesh mesh;
  mesh.name = "pair";
  add_block(mesh, "low", {0, -4}, {8, 0}, 8, 4, {"displacement", "force", "contact:low", "force"});
  add_block(mesh, "high", {0, 0}, {8, 4}, 8, 4, {"contact:high", "force", "force:top", "force"});
  Scene scene = weighing(0);
  scene.friction = 0;
  scene.contacts = {{.between = {{{"contact:low"}, {"contact:high"}}}}};
  scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{50, 50}};
  scene.point_supports = {point({4, 0}, 0, {})};
  const auto refusal = [&] {
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  testing::expect_named(refusal(), {"point_supports: [4, 0] lies in the bodies high, low"});
  scene.point_supports.front().body = "low";
  testing::expect_named(refusal(), {"[4, 0] holds x, which displacement edges"});
  scene.point_supports.front().body = "high";
  for (const char* name : {"HYBRID", "P2"}) {
    const testing::SolvedScene solved(scene, mesh, name);
    const DisplacementField u = displacement_of(solved);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (mesh.vertices[v] == Vector2d(4, 0) && v >= 9 * 5) {
        EXPECT_NEAR(u(0, static_cast<Eigen::Index>(v)), 0, 1e-12) << name;
      }
    }
  }
}

}  // namespace
}  // namespace airybench::point_supports_test
