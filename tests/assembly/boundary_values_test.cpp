// Tractions and supports by boundary groups: what they become, and what is refused.
#include "assembly/problem/boundary_values.hpp"

#include <gtest/gtest.h>

#include "assembly/dual_system.hpp"
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
    const DualSystem system = assemble(problem);
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
  EXPECT_EQ(assemble(problem).n_f(), 4 * 4 + 2 * 3 + 2 * 3 + 2 * 4);
}

std::string complaint(const std::function<void(Scene&)>& spoil,
                      Mesh mesh = testing::small_block(4, 4, 0)) {
  Scene scene;
  scene.source = "s.json";
  spoil(scene);
  return testing::complaint_of<SceneError>([&] { pose(scene, std::move(mesh)); });
}

TEST(BoundaryValues, ContradictionsAreRefused) {
  const auto with = [](const std::string& label, const std::function<void(BoundaryValues&)>& give) {
    return complaint([&](Scene& scene) { give(scene.boundary[label]); });
  };
  const auto pull = [](BoundaryValues& v) { v.traction_MPa = constant(1, 0); };
  const auto press = [](BoundaryValues& v) { v.pressure_MPa = LinearValue<double>{{1, 1}}; };
  const auto move = [](BoundaryValues& v) { v.displacement_mm = constant(1, 0); };
  const auto roll = [](BoundaryValues& v) { v.support = Support::normal; };
  const std::string none = ": no such group in the mesh small block",
                    groups = " (its groups: contact, displacement:root, force:bottom, force:top)";
  EXPECT_EQ(with("force:tip", pull),
            "s.json: boundary: force:tip" + none + ", perhaps force:top" + groups);
  EXPECT_EQ(with("top", press), "s.json: boundary: top" + none + groups);
  EXPECT_EQ(with("displacement:root", pull),
            "s.json: boundary: displacement:root: traction_MPa (allowed: on a force boundary)");
  EXPECT_EQ(with("contact", press),
            "s.json: boundary: contact: pressure_MPa (allowed: on a force boundary)");
  EXPECT_EQ(with("force:top", move),
            "s.json: boundary: force:top: displacement_mm (allowed: on a displacement boundary)");
  EXPECT_EQ(with("force:top", roll),
            "s.json: boundary: force:top: support (allowed: on a displacement boundary)");
  EXPECT_EQ(with("force:top",
                 [&](BoundaryValues& v) {
                   pull(v);
                   press(v);
                 }),
            "s.json: boundary: force:top: traction_MPa and pressure_MPa (allowed: one of them)");
  EXPECT_EQ(
      with("force:top", [](BoundaryValues& v) { v.traction_MPa = constant(std::nan(""), 0); }),
      "s.json: boundary: force:top: traction_MPa: [nan, 0] (allowed: -1e30 to 1e30 MPa)");
  EXPECT_EQ(with("force:top",
                 [](BoundaryValues& v) {
                   v.pressure_MPa =
                       LinearValue<double>{{1, 2}, {Eigen::Vector2d(3, 4), Eigen::Vector2d(3, 4)}};
                 }),
            "s.json: boundary: force:top: pressure_MPa: at_mm: [3, 4] twice (allowed: two "
            "different points)");
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
  const std::string jump =
                        "s.json: boundary: displacement:floor and displacement:root: "
                        "displacement_mm: ",
                    allowed =
                        " at their common vertex [0, 0] (allowed: equal, of rollers along "
                        "their normal)";
  EXPECT_EQ(with(constant(1, 0), constant(3, 0), false, false),
            jump + "[3, 0] and [1, 0]" + allowed);
  EXPECT_EQ(with(constant(1, 2), constant(1, 0), false, true),
            jump + "[1, 0] and [1, 2]" + allowed);
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
  const std::string allowed = " (allowed: supports that hold it, or contact edges)";
  EXPECT_EQ(complaint(roll, without_contact(testing::small_block(4, 4, 0))),
            "s.json: boundary: support: normal leaves the body free to move along "
            "[0, 1]" +
                allowed);
  EXPECT_EQ(
      complaint(roll, without_contact(testing::small_block(4, 4, 90))),
      "s.json: boundary: support: normal leaves the body free to move along [1, 0]" + allowed);
  const std::string turned = complaint(roll, without_contact(testing::small_block(4, 4, 45)));
  EXPECT_TRUE(
      turned.starts_with("s.json: boundary: support: normal leaves the body free to move "
                         "along [0.707107, -0.707107]"))
      << turned;

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
