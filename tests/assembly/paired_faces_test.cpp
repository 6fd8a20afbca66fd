// Faces that meet each other: how they are matched, and what a scene may not say of them.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/problem/matched_faces.hpp"
#include "assembly/problem/pose.hpp"
#include "mesh/arcs.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::paired_faces_test {
namespace {

using testing::add_block;
using testing::pressed;
using testing::two_blocks;

TEST(PairedFaces, MatchOneToOneWithSomeVerticesMoved) {
  const MatchedFaces matched = with_matched_faces(two_blocks(13, 17), pressed(0.3));
  const auto& [inserted, moved, has_curves] = matched.changes;
  EXPECT_EQ(inserted + 2 * moved, 12 + 16);
  EXPECT_GT(moved, 0);
  EXPECT_FALSE(has_curves);
  EXPECT_NO_THROW(validate(matched.mesh));
  int pairs = 0;
  for (std::size_t row = 0; row < matched.edges.size(); ++row)
    if (const auto& edge = matched.edges[row]) {
      const auto& [a, b] = matched.mesh.boundary[row].vertices;
      const auto& [c, d] = matched.mesh.boundary[static_cast<std::size_t>(edge->opposite)].vertices;
      EXPECT_EQ(matched.edges[static_cast<std::size_t>(edge->opposite)]->opposite,
                static_cast<int>(row));
      EXPECT_LT((matched.mesh.vertices[a] - matched.mesh.vertices[d]).norm(), 1e-12);
      EXPECT_LT((matched.mesh.vertices[b] - matched.mesh.vertices[c]).norm(), 1e-12);
      ++pairs;
    }
  EXPECT_EQ(pairs, 2 * (13 + 17 - 1 - moved));
  const MatchedFaces again = with_matched_faces(matched.mesh, pressed(0.3));
  EXPECT_EQ(again.changes.inserted + again.changes.moved, 0);
}

// A hub in a rim, of which the meshes know that they are round: two quarters.
Mesh hub_and_rim() {
  Mesh mesh = testing::quarter_ring(9, 2, 2, 5);
  const Mesh rim = testing::quarter_ring(7, 2, 5, 9);
  const int before = static_cast<int>(mesh.vertices.size());
  mesh.body_names.emplace_back("rim");
  mesh.vertices.insert(mesh.vertices.end(), rim.vertices.begin(), rim.vertices.end());
  for (std::array<int, 3> triangle : rim.triangles) {
    for (int& v : triangle) v += before;
    mesh.triangles.push_back(triangle);
    mesh.triangle_body.push_back(1);
  }
  for (BoundaryEdge edge : rim.boundary) {
    for (int& v : edge.vertices) v += before;
    edge.group = boundary_group(mesh, "of rim, " + boundary_label(rim, edge));
    mesh.boundary.push_back(edge);
  }
  for (BoundaryEdge& edge : mesh.boundary) {
    const std::string label = boundary_label(mesh, edge);
    if (label == "force:rim" || label.ends_with("of rim, force:hole")) {
      edge.role = BoundaryRole::contact;
      edge.group = boundary_group(mesh, label == "force:rim" ? "hub" : "rim");
    }
  }
  validate(mesh);
  EXPECT_EQ(recognise_arcs(mesh), 2 * (9 + 7));
  return mesh;
}

TEST(PairedFaces, RoundOnesMeetOnTheirCircle) {
  Scene scene;
  scene.contacts.push_back({.between = {{{"contact:hub"}, {"contact:rim"}}}});
  const MatchedFaces matched = with_matched_faces(hub_and_rim(), scene);
  EXPECT_TRUE(matched.changes.has_curves);
  EXPECT_GT(matched.changes.inserted, 5);
  EXPECT_NO_THROW(validate(matched.mesh));
  int pairs = 0;
  for (std::size_t row = 0; row < matched.edges.size(); ++row)
    if (const auto& edge = matched.edges[row]) {
      const BoundaryEdge &own = matched.mesh.boundary[row],
                         &other = matched.mesh.boundary[static_cast<std::size_t>(edge->opposite)];
      for (const double s : {0., 0.3, 0.5, 1.}) {
        EXPECT_NEAR(point_on(matched.mesh, own, s).norm(), 5, 1e-10);
        EXPECT_LT((point_on(matched.mesh, own, s) - point_on(matched.mesh, other, 1 - s)).norm(),
                  1e-9);
      }
      for (const double gap : edge->gap_mm) EXPECT_NEAR(gap, 0, 1e-10);
      const Eigen::Vector2d x = matched.mesh.vertices[own.vertices[0]];
      EXPECT_LT(std::abs(cross(edge->normals.at(0, 1), x)), 1e-9);
      ++pairs;
    }
  EXPECT_EQ(pairs, 2 * (9 + 7 - 1 - matched.changes.moved));
}

TEST(PairedFaces, WhatCannotBeIsRefusedInALine) {
  const auto in_step = [](Scene& scene) -> LoadStep& {
    scene.later_steps.resize(1);
    return scene.later_steps[0];
  };
  const auto pair_of_step = [&](Scene& scene) -> ContactPair& {
    LoadStep& step = in_step(scene);
    step.contacts = {{.between = scene.contacts[0].between, .clearance_mm = 0.1}};
    return step.contacts[0];
  };
  struct Case {
    std::function<void(Scene&)> change;
    std::vector<std::string> named;
  };
  const std::string no_wall = "where all contact groups are in contacts";
  for (const auto& [change, named] : std::vector<Case>{
           {[](Scene& s) {
              s.contacts[0].between[1] = {"contact:bse"};
              s.boundary["contact:base"].contact.face = FlatWall{{0, 0}, {0, 1}};  // of a pair
            },
            {"contacts: between: contact:bse", "perhaps contact:base"}},
           {[](Scene& s) { s.contacts.push_back(s.contacts[0]); },
            {"contacts: between: contact:block again"}},
           {[](Scene& s) { s.contacts.clear(); }, {"mesh blocks: 2 separate pieces", "[0, 0]"}},
           {[](Scene& s) { s.contacts[0].clearance_mm = -INFINITY; },
            {"contacts: clearance_mm: -inf"}},
           {[](Scene& s) { s.boundary["contact:base"].contact.friction = 0.1; },
            {"boundary: contact:base: friction"}},
           {[&](Scene& s) { in_step(s).boundary["contact:base"].contact.clearance_mm = 0.1; },
            {"load_steps: 1: boundary: contact:base: clearance_mm"}},
           {[&](Scene& s) { pair_of_step(s).clearance_mm = -2; },
            {"contacts: contact:block and contact:base: overlap by: 2 mm at [0, 0]"}},
           {[&](Scene& s) {
              ContactPair& pair = pair_of_step(s);
              std::swap(pair.between[0], pair.between[1]);
            },
            {"load_steps: 1: contacts: between: contact:base and contact:block"}},
           {[&](Scene& s) { pair_of_step(s).friction = 0.1; },
            {"load_steps: 1: contacts: contact:block and contact:base", "no friction"}},
           {[&](Scene& s) { pair_of_step(s).clearance_mm.reset(); },
            {"load_steps: 1: contacts: contact:block and contact:base", "clearance_mm"}},
           {[&](Scene& s) {
              const ContactPair pair = pair_of_step(s);
              in_step(s).contacts.push_back(pair);
            },
            {"load_steps: 1: contacts: between: contact:block and contact:base twice"}},
           {[&](Scene& s) { pair_of_step(s).clearance_mm = NAN; },
            {"load_steps: 1: contacts: clearance_mm: nan"}},
           // Keys of walls, of which there are none.
           {[](Scene& s) { s.clearance_mm = 0.1; }, {"clearance_mm: 0.1 ", no_wall}},
           {[](Scene& s) {
              s.wall = FlatWall{Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1)};
            },
            {"wall: ", no_wall}},
           {[&](Scene& s) { in_step(s).clearance_mm = 0.1; },
            {"load_steps: 1: clearance_mm: 0.1 ", no_wall}},
       }) {
    Scene scene = pressed(0.3);
    change(scene);
    testing::expect_named(
        testing::complaint_of<SceneError>([&] { pose(scene, two_blocks(7, 10)); }), named);
  }
}

// The place would belong to two contact points.
TEST(PairedFaces, ThatMeetAPlaceTwiceAreRefused) {
  Scene scene = pressed(0.3);
  scene.materials = {{"base", {70000, 0.33}}, {"left", {210000, 0.3}}, {"right", {210000, 0.3}}};
  scene.contacts[0].between[0] = {"contact:left", "contact:right"};
  const auto side_by_side = [&](int base, double gap_mm) {
    Mesh mesh;
    mesh.name = "side by side";
    add_block(mesh, "base", {0, -6}, {12, 0}, base, 5,
              {"displacement:floor", "force", "contact:base", "force"});
    add_block(mesh, "left", {1, 0}, {6, 5}, 4, 4,
              {"contact:left", "force", "displacement:head", "force"});
    add_block(mesh, "right", {6 + gap_mm, 0}, {11, 5}, 5, 4,
              {"contact:right", "force", "displacement:head", "force"});
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  for (const int base : {12, 7}) {  // at a vertex of the base, and inside an edge
    EXPECT_EQ(side_by_side(base, 0.1), "no complaint") << base;
    testing::expect_named(
        side_by_side(base, 0),
        {"contacts: contact:left, contact:right and contact:base: meet twice at [6, 0]"});
  }
}

TEST(PairedFaces, HaveTheirCurveWhereTheirEdgesAre) {
  Scene scene = pressed(0.3);
  const auto lowered_by = [&](double mm) {
    scene.boundary["contact:base"].contact.face =
        CircularWall{{6, -400 - mm}, 400, CircularWall::Bodies::inside};
    return testing::complaint_of<SceneError>([&] { pose(scene, two_blocks(8, 8)); });
  };
  EXPECT_EQ(lowered_by(0), "no complaint");
  EXPECT_TRUE(lowered_by(3).starts_with("default scene: contact:base: face: is 3.0"))
      << lowered_by(3);
}

// The flat of half a pin is at a right angle to the pin, not to the hole around it.
TEST(PairedFaces, MayMeetARollerAtARightAngle) {
  Mesh mesh;
  mesh.name = "pin";
  const std::array angles = {-std::numbers::pi / 2, std::numbers::pi / 2};
  testing::add_ring_sector(mesh, "pin", {2, 5, 9.5}, 24, "force", "contact:pin",
                           {angles, {"displacement:flat", "displacement:flat"}});
  const std::size_t of_pin = mesh.vertices.size();
  for (Eigen::Vector2d& x : mesh.vertices) x.x() += 0.5;
  testing::add_ring_sector(mesh, "lug", {10, 14}, 31, "contact:hole", "displacement:rim",
                           {angles, {"force", "force"}});
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.friction = 0;
  scene.contacts = {{.between = {{{"contact:pin"}, {"contact:hole"}}}}};
  scene.boundary["displacement:flat"].support = BoundaryValues::Support::normal;
  scene.boundary["displacement:rim"].displacement_mm =
      LinearValue<Eigen::Vector2d>{{Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0)}};
  scene.boundary["contact:pin"].contact.face =
      CircularWall{{0.5, 0}, 9.5, CircularWall::Bodies::inside};
  scene.boundary["contact:hole"].contact.face =
      CircularWall{{0, 0}, 10, CircularWall::Bodies::inside};
  const Problem problem = pose(scene, mesh);
  int ends = 0;
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row)
    for (const int end : {0, 1}) {
      const int v = problem.mesh.boundary[row].vertices[end];
      if (boundary_label(problem.mesh, problem.mesh.boundary[row]) != "contact:pin" ||
          std::abs(problem.mesh.vertices[v].x() - 0.5) > 1e-9)
        continue;
      const Eigen::Vector2d n = problem.frame_at(static_cast<int>(row), end, 1).normal;
      EXPECT_NEAR(n.x(), 0, 1e-9);
      ++ends;
    }
  EXPECT_EQ(ends, 2);
  for (std::size_t v = 0; v < of_pin; ++v) mesh.vertices[v].y() += 0.1 * (mesh.vertices[v].x() - 5);
  scene.boundary["contact:pin"].contact.face.reset();
  EXPECT_NE(testing::complaint_of<SceneError>([&] {
              pose(scene, mesh);
            }).find("a roller meets the face obliquely (allowed: at a right angle)"),
            std::string::npos);
}

// It leaves the group, whose name the scene may still have.
TEST(PairedFaces, AGroupThatFacesNothingMayHaveValues) {
  Scene scene = pressed(0.3);
  scene.contacts[0].between[1] = {"contact:base", "contact:side"};
  scene.boundary["contact:side"] = {};
  const Mesh mesh = testing::with_contact_beside(two_blocks(8, 8));
  EXPECT_EQ(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }), "no complaint");
  scene.boundary["contact:sied"] = {};
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }),
                        {"boundary: contact:sied: no such group", "contact:side"});
}

}  // namespace
}  // namespace airybench::paired_faces_test
