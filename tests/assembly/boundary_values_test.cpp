// Tractions and supports by boundary groups: what they become, and what is refused.
#include "assembly/problem/boundary_values.hpp"

#include <gtest/gtest.h>

#include "assembly/airy_system.hpp"
#include "assembly/problem/pose.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::boundary_values_test {
namespace {

using Vector = LinearValue<Eigen::Vector2d>;
using Support = BoundaryValues::Support;

Vector constant(double x, double y) { return {{Eigen::Vector2d(x, y), Eigen::Vector2d(x, y)}}; }

TEST(BoundaryValues, ALinearValueIsLinearAlongItsPointsAndConstantAcross) {
  const LinearValue<double> value{{10, 30}, {Eigen::Vector2d(1, 1), Eigen::Vector2d(3, 1)}};
  EXPECT_EQ(value.at({1, 1}), 10);
  EXPECT_EQ(value.at({2, 7}), 20);
  EXPECT_EQ(value.at({4, -3}), 40);  // and beyond
  EXPECT_EQ(constant(2, 3).at({8, 9}), Eigen::Vector2d(2, 3));
}

TEST(BoundaryValues, GroupsHaveTheirOwnAndTheRestTheScenes) {
  Scene scene;
  scene.displacement_mm = {0.5, 0.25};
  scene.boundary["displacement:root"].displacement_mm =
      Vector{{Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 0.5)},
             {Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 10)}};  // equal where they meet, at y = 5
  scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{7, 7}};
  scene.boundary["force:bottom"].traction_MPa = constant(1, 2);
  Mesh mesh = testing::small_block(4, 4, 0);
  for (BoundaryEdge& edge : mesh.boundary)  // half of the root keeps the plain name
    if (boundary_label(mesh, edge) == "displacement:root" &&
        mesh.vertices[edge.vertices[0]].y() > 5.1)
      edge.group = BoundaryEdge::no_group;
  const Problem problem = pose(scene, mesh);
  const auto u0 = [&](const Eigen::Vector2d& x, int row) -> Eigen::Vector2d {
    return problem.motion.at(x) + problem.loads.displacement_mm(x, row);
  };
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const std::string label = boundary_label(mesh, mesh.boundary[row]);
    const Eigen::Vector2d x(2, 2), n(0, 1);
    const auto& loads = problem.loads;
    if (label == "displacement:root") {
      EXPECT_LT((u0(x, row) - Eigen::Vector2d(0.8, 0.1)).norm(), 1e-15);
    } else if (label == "displacement") {
      EXPECT_LT((u0(x, row) - Eigen::Vector2d(0.5, 0.25)).norm(), 1e-15);
    } else if (label == "force:top") {
      EXPECT_EQ(loads.traction_MPa(x, n, row), -7 * n);
    } else if (label == "force:bottom") {
      EXPECT_EQ(loads.traction_MPa(x, n, row), Eigen::Vector2d(1, 2));
    }
    EXPECT_FALSE(problem.is_roller(row));
  }
  EXPECT_TRUE(problem.loads.rollers.empty());
}

TEST(BoundaryValues, WhatIsZeroCostsNothing) {
  Scene scene;
  scene.displacement_mm.setZero();
  scene.boundary["force:top"].traction_MPa = constant(0, 0);
  const Problem problem = pose(scene, testing::small_block(4, 4, 0));
  EXPECT_FALSE(problem.loads.displacement_mm);
  EXPECT_FALSE(problem.loads.traction_MPa);
}

TEST(BoundaryValues, ARollersTangentialForcesAreRowsOfTheForcesThatAreKnown) {
  Scene scene;
  const Mesh mesh = testing::small_block(4, 3, 0);  // three edges at the root, four at the bottom
  const auto rows = [&] {
    const auto problem = testing::posed(scene, mesh);
    const AirySystem system = airy_system(problem);
    return std::pair(system.n_f(), system.n_c());
  };
  EXPECT_EQ(rows(), std::pair(4 * 8, 4 * 3));
  scene.friction = 0;
  EXPECT_EQ(rows(), std::pair(4 * 8 + 2 * 3, 2 * 3));
  scene.boundary["displacement:root"].support = Support::normal;
  Mesh held = mesh;
  for (BoundaryEdge& edge : held.boundary)
    if (boundary_label(held, edge) == "force:bottom") edge.role = BoundaryRole::displacement;
  scene.boundary["displacement:bottom"].support = Support::normal;
  const auto problem = testing::posed(scene, held);
  EXPECT_EQ(airy_system(problem).n_f(), 4 * 4 + 2 * 3 + 2 * 3 + 2 * 4);
}

std::string complaint(const std::function<void(Scene&)>& spoil,
                      Mesh mesh = testing::small_block(4, 4, 0)) {
  Scene scene;
  scene.source = "s.json";
  spoil(scene);
  return testing::complaint_of<SceneError>([&] { pose(scene, std::move(mesh)); });
}

TEST(BoundaryValues, ContradictionsAreRefused) {
  using Give = void (*)(BoundaryValues&);
  const Give pull = [](BoundaryValues& v) { v.traction_MPa = constant(1, 0); };
  const Give press = [](BoundaryValues& v) { v.pressure_MPa = LinearValue<double>{{1, 1}}; };
  const Give both = [](BoundaryValues& v) {
    v.traction_MPa = constant(1, 0);
    v.pressure_MPa = LinearValue<double>{{1, 1}};
  };
  const Give at_one_point = [](BoundaryValues& v) {
    v.pressure_MPa = LinearValue<double>{{1, 2}, {Eigen::Vector2d(3, 4), Eigen::Vector2d(3, 4)}};
  };
  const std::string groups = "(its groups: contact, displacement:root, force:bottom, force:top)";
  struct Case {
    const char* label;
    Give give;
    std::vector<std::string> named;
  };
  for (const auto& [label, give, named] :
       std::vector<Case>{{"force:tip", pull, {"no such group", "perhaps force:top", groups}},
                         {"top", press, {"no such group", groups}},
                         {"displacement:root", pull, {"traction_MPa", "on a force boundary"}},
                         {"contact", press, {"pressure_MPa", "on a force boundary"}},
                         {"force:top",
                          [](BoundaryValues& v) { v.displacement_mm = constant(1, 0); },
                          {"displacement_mm", "on a displacement boundary"}},
                         {"force:top",
                          [](BoundaryValues& v) { v.support = Support::normal; },
                          {"support", "on a displacement boundary"}},
                         {"force:top", both, {"traction_MPa and pressure_MPa"}},
                         {"force:top",
                          [](BoundaryValues& v) { v.traction_MPa = constant(std::nan(""), 0); },
                          {"traction_MPa: [nan, 0]"}},
                         {"force:top", at_one_point, {"pressure_MPa: at_mm: [3, 4] twice"}}}) {
    const std::string what =
        complaint([of = label, change = give](Scene& scene) { change(scene.boundary[of]); });
    EXPECT_TRUE(what.starts_with("s.json: boundary: " + std::string(label) + ": ")) << what;
    testing::expect_named(what, named);
  }
}

TEST(BoundaryValues, DisplacementsThatJumpAreRefused) {
  Mesh mesh = testing::small_block(4, 4, 0);
  for (BoundaryEdge& edge : mesh.boundary)
    if (boundary_label(mesh, edge) == "force:bottom")
      edge = {edge.vertices, BoundaryRole::displacement, boundary_group(mesh, "floor")};
  const auto with = [&](const Vector& root, const Vector& floor, bool root_rolls,
                        bool floor_rolls) {
    Scene scene;
    scene.source = "s.json";
    const auto set = [&](const char* label, const Vector& value, bool rolls) {
      scene.boundary[label].displacement_mm = value;
      scene.boundary[label].support = rolls ? Support::normal : Support::full;
    };
    set("displacement:root", root, root_rolls);
    set("displacement:floor", floor, floor_rolls);
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  const Vector turning{{Eigen::Vector2d(1, 0), Eigen::Vector2d(2, 7)},
                       {Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 0)}};
  EXPECT_EQ(with(constant(1, 0), turning, false, false), "no complaint");
  EXPECT_EQ(with(constant(1, 0), constant(3, 0), false, true), "no complaint");
  EXPECT_EQ(with(constant(1, 2), constant(3, 0), true, true), "no complaint");
  const std::string jump = "boundary: displacement:floor and displacement:root: displacement_mm: ";
  testing::expect_named(with(constant(1, 0), constant(3, 0), false, false),
                        {jump + "[3, 0] and [1, 0]", "[0, 0]"});
  testing::expect_named(with(constant(1, 2), constant(1, 0), false, true),
                        {jump + "[1, 0] and [1, 2]", "[0, 0]"});
}

TEST(BoundaryValues, ABodyThatIsNotHeldIsRefusedAndItsFreeMotionNamed) {
  const auto roll = [](Scene& scene) {
    scene.boundary["displacement:root"].support = Support::normal;
  };
  const auto without_contact = [](Mesh mesh) {
    for (BoundaryEdge& edge : mesh.boundary)
      if (edge.role == BoundaryRole::contact) edge.role = BoundaryRole::force;
    return mesh;
  };
  for (const auto& [degrees, direction] :
       {std::pair(0, "[0, 1]"), {90, "[1, 0]"}, {45, "[0.707107, -0.707107]"}})
    testing::expect_named(complaint(roll, without_contact(testing::small_block(4, 4, degrees))),
                          {"s.json: boundary: support: normal ", direction});

  // Another roller across, or one edge that is held fully, is enough.
  Mesh held = testing::small_block(4, 4, 30);
  for (BoundaryEdge& edge : held.boundary)
    if (boundary_label(held, edge) == "force:bottom") edge.role = BoundaryRole::displacement;
  EXPECT_EQ(complaint(roll, held), "no complaint");
  EXPECT_EQ(complaint(
                [&](Scene& scene) {
                  roll(scene);
                  scene.boundary["displacement:bottom"].support = Support::normal;
                },
                held),
            "no complaint");
}

}  // namespace
}  // namespace airybench::boundary_values_test
