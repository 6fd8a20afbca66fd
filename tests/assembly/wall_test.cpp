// Walls: the gap along an edge's normal, what is out of reach, groups of their own, what is
// refused.
#include "assembly/problem/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/airy_system.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/pose.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::wall_test {
namespace {

using Eigen::Vector2d;
using enum CircularWall::Bodies;

TEST(Wall, DistanceAlongARay) {
  const Vector2d down(0, -1), slant = Vector2d(3, -4) / 5;
  const Wall floor = FlatWall{{5, 1}, {0, 2}};
  EXPECT_NEAR(distance_along(floor, {0, 3}, down).value(), 2, 1e-15);
  EXPECT_NEAR(distance_along(floor, {0, 3}, slant).value(), 2.5, 1e-15);
  EXPECT_NEAR(distance_along(floor, {0, 0.5}, down).value(), -0.5, 1e-15);  // behind it
  EXPECT_FALSE(distance_along(floor, {0, 3}, Vector2d(0, 1)));              // away from it
  EXPECT_FALSE(distance_along(floor, {0, 3}, Vector2d(1, 0)));

  const Wall socket = CircularWall{{0, 0}, 5, inside}, disc = CircularWall{{0, 0}, 5, outside};
  EXPECT_NEAR(distance_along(socket, {3, 0}, down).value(), 4, 1e-15);
  EXPECT_NEAR(distance_along(socket, {0, -5.5}, down).value(), -0.5, 1e-15);
  EXPECT_NEAR(distance_along(disc, {3, 10}, down).value(), 6, 1e-14);
  EXPECT_NEAR(distance_along(disc, {3, 3.9}, down).value(), -0.1, 1e-14);
  EXPECT_FALSE(distance_along(disc, {5.1, -10}, down));
  EXPECT_FALSE(distance_along(disc, {5.1, 10}, down));
  EXPECT_NEAR(distance_to_either_side(disc, {3, -4.2}, down).value(), -0.2, 1e-14);

  // The free side is on the left of the walk; the ray meets the nearer piece.
  const Wall steps = PolylineWall{{{0, 0}, {2, 0}, {2, 1}, {4, 1}}};
  EXPECT_NEAR(distance_along(steps, {1, 3}, down).value(), 3, 1e-15);
  EXPECT_NEAR(distance_along(steps, {3, 3}, down).value(), 2, 1e-15);
  EXPECT_NEAR(distance_along(steps, {1, 0.5}, Vector2d(1, 0)).value(), 1, 1e-15);
  EXPECT_TRUE(distance_along(steps, {2, 3}, down));  // nothing passes between two pieces
  EXPECT_FALSE(distance_along(steps, {5, 3}, down));
  EXPECT_FALSE(distance_along(PolylineWall{{{4, 1}, {0, 0}}}, {1, 3}, down));
}

// A block whose face x = 10 is contact, in its own place or turned.
struct Turned {
  double degrees;
  Eigen::Matrix2d turn;
  Mesh mesh;
  explicit Turned(double angle) : degrees(angle), mesh(testing::small_block(4, 4, angle)) {
    const double a = angle / 180 * std::acos(-1);
    turn << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
  }
};

Scene scene_with(const Wall& wall) {
  Scene scene;
  scene.wall = wall;
  return scene;
}

TEST(Wall, GapsOfAFlatAndACircularWallHoweverTheBodyIsTurned) {
  for (const double angle : {0., 33., 211.}) {
    const Turned block(angle);
    const auto at = [&](double x, double y) -> Vector2d { return block.turn * Vector2d(x, y); };
    const Problem flat = pose(scene_with(FlatWall{at(10.5, 0), at(-1, 0.1)}), block.mesh);
    const Problem disc = pose(scene_with(CircularWall{at(10 + 20.25, 5), 20, outside}), block.mesh);
    const Problem socket = pose(scene_with(CircularWall{at(0, 5), 15, inside}), block.mesh);
    int edges = 0;
    for (int row = 0; row < static_cast<int>(block.mesh.boundary.size()); ++row) {
      if (block.mesh.boundary[row].role != BoundaryRole::contact) continue;
      ++edges;
      const auto [a, b] = block.mesh.boundary[row].vertices;
      for (const double s : {0., 0.5, 1.}) {
        const Vector2d x = (1 - s) * block.mesh.vertices[a] + s * block.mesh.vertices[b];
        const double y = (block.turn.transpose() * x).y() - 5;
        // The distances to the walls' nearest points.
        EXPECT_NEAR(flat.loads.gap_mm(x, row), (0.5 + 0.1 * (y + 5)) / std::hypot(1, 0.1), 1e-13);
        EXPECT_NEAR(disc.loads.gap_mm(x, row), std::hypot(20.25, y) - 20, 1e-13);
        EXPECT_NEAR(socket.loads.gap_mm(x, row), 15 - std::hypot(10, y), 1e-13);
      }
    }
    EXPECT_EQ(edges, 4);
  }
}

TEST(Wall, AFaceIsWhereItsEdgesAreChords) {
  // The chord of an arc of radius 100 about (-90, 5), which the contact side is declared to be.
  const Mesh block = testing::small_block(1, 4, 0);
  Scene scene = scene_with(FlatWall{{10.5, 0}, {-1, 0}});
  scene.face = CircularWall{{-90, 5}, 100, inside};
  const Problem problem = pose(scene, block);
  for (int row = 0; row < static_cast<int>(block.boundary.size()); ++row)
    if (block.boundary[row].role == BoundaryRole::contact) {
      const Vector2d x = block.vertices[block.boundary[row].vertices[0]];
      const double sagitta = 100 - std::sqrt(1e4 - std::pow(x.y() - 5, 2));
      EXPECT_NEAR(problem.loads.gap_mm(x, row), 0.5 + sagitta, 1e-12);
    }
}

TEST(Wall, EdgesOutOfReachBecomeForceEdges) {
  const Mesh block = testing::small_block(4, 4, 0);
  // A short wall in front of the lower part of the side: edges of 2.5 mm, met up to y = 5.
  const Problem problem = pose(scene_with(PolylineWall{{{11, -1}, {11, 5.5}}}), block);
  EXPECT_EQ(mesh_sizes(block).contact_edges, 4);
  EXPECT_EQ(mesh_sizes(problem.mesh).contact_edges, 3);  // the third at its start only
  for (int row = 0; row < static_cast<int>(block.boundary.size()); ++row)
    if (problem.mesh.boundary[row].role == BoundaryRole::contact) {
      EXPECT_NEAR(problem.loads.gap_mm({10, 6}, row), 1, 1e-14);
    }
}

TEST(Wall, EdgesOutOfReachAreFreeWhateverTheirGroupIsCalled) {
  Mesh block = testing::small_block(4, 4, 0);
  Scene scene = scene_with(PolylineWall{{{11, -1}, {11, 5.5}}});
  scene.boundary["force"].pressure_MPa = LinearValue<double>{{100, 100}};
  for (BoundaryEdge& edge : block.boundary)  // a group of force edges with contact's name
    if (boundary_label(block, edge) == "force:top") edge.group = BoundaryEdge::no_group;
  const Problem problem = pose(scene, block);
  int free = 0;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (block.boundary[row].role == BoundaryRole::contact &&
        problem.mesh.boundary[row].role == BoundaryRole::force) {
      EXPECT_EQ(boundary_label(problem.mesh, problem.mesh.boundary[row]), "force:out of reach");
      EXPECT_TRUE(problem.loads.traction_MPa({10, 9}, {1, 0}, row).isZero(0));
      ++free;
    }
  EXPECT_EQ(free, 1);
}

TEST(Wall, SidesAlongTheWallsNormalAreOutOfReachHoweverTheBodyIsTurned) {
  for (const double angle : {0., 0.1, 33., 211.}) {
    Turned block(angle);
    for (BoundaryEdge& edge : block.mesh.boundary)
      if (edge.role == BoundaryRole::force)
        edge = {edge.vertices, BoundaryRole::contact, BoundaryEdge::no_group};
    const Vector2d towards = block.turn * Vector2d(-1, 0), point = block.turn * Vector2d(10.5, 0);
    const Problem problem = pose(scene_with(FlatWall{point, towards}), block.mesh);
    EXPECT_EQ(mesh_sizes(problem.mesh).contact_edges, 4) << angle;
    EXPECT_TRUE(problem.contact_normals.empty()) << angle;  // the face's own
  }
}

TEST(Wall, ContactGroupsHaveTheirOwnWallFrictionAndClearance) {
  Mesh block = testing::small_block(4, 4, 0);
  const int upper = boundary_group(block, "upper");
  for (BoundaryEdge& edge : block.boundary)
    if (edge.role == BoundaryRole::contact && block.vertices[edge.vertices[0]].y() > 4.9)
      edge.group = upper;
  Scene scene = scene_with(FlatWall{{10, 0}, {-1, 0}});
  scene.friction = 0.3;
  ContactValues& own = scene.boundary["contact:upper"].contact;
  own.friction = 0;
  own.clearance_mm = 0.25;
  own.wall = FlatWall{{10.5, 0}, {-1, 0}};
  const AirySystem system = airy_system(testing::posed(scene, block));
  EXPECT_EQ(system.contact.components, 2);
  int of_upper = 0;
  for (int p = 0; p < system.contact.count; ++p) {
    const int row = system.contact.boundary[p];
    const bool up = boundary_label(block, block.boundary[row]) == "contact:upper";
    of_upper += up ? 1 : 0;
    EXPECT_EQ(system.contact.friction_at(p), up ? 0 : 0.3);
    EXPECT_EQ(system.problem->loads.gap_mm({10, 6}, row), up ? 0.75 : 0);
  }
  EXPECT_EQ(of_upper, 4);
  scene.friction = 0;
  EXPECT_FALSE(pose(scene, block).has_friction());
}

std::string complaint(const Scene& scene) {
  return testing::complaint_of<SceneError>([&] { pose(scene, testing::small_block(4, 4, 0)); });
}

TEST(Wall, WhatCannotBeAWall) {
  const Wall wall = FlatWall{{10, 0}, {-1, 0}};
  const auto refuses = [](const Scene& scene, const std::vector<std::string>& named) {
    testing::expect_named(complaint(scene), named);
  };
  for (const auto& [wrong, named] : std::vector<std::pair<Wall, std::vector<std::string>>>{
           {FlatWall{{10, 0}, {1, 0}}, {"boundary: contact: wall: ", "no edge meets it"}},
           {FlatWall{{5, 0}, {-1, 0}}, {"boundary: contact: wall: ", "5 mm inside", "[10, 0]"}},
           {FlatWall{{10, 0}, {0, 0}}, {"wall: flat: normal: [0, 0]"}},
           {CircularWall{{20, 5}, -1, outside}, {"wall: circle: radius_mm: -1"}},
           {CircularWall{{20, std::nan("")}, 1, outside}, {"wall: circle: centre_mm: [20, nan]"}},
           {PolylineWall{{{1, 2}}}, {"wall: polyline: 1 point"}},
           {PolylineWall{{{1, 2}, {1, 2}}}, {"wall: polyline: point 2: [1, 2]"}}})
    refuses(scene_with(wrong), named);
  Scene scene = scene_with(wall);
  scene.face = CircularWall{{0, 5}, 12, inside};
  refuses(scene, {"boundary: contact: face: ", "0.908712 mm", "[10, 0]"});
  scene.wall.reset();
  refuses(scene, {"face: given without a wall"});
  const auto with = [](const char* label, const auto& change) {
    Scene changed;
    change(changed.boundary[label].contact);
    return changed;
  };
  refuses(with("contact",
               [](ContactValues& c) {
                 c.face = CircularWall{{0, 5}, 12, inside};
               }),
          {"boundary: contact: face without a wall"});
  refuses(with("force:top", [](ContactValues& c) { c.friction = 0.1; }),
          {"boundary: force:top: friction"});
  refuses(with("contact", [](ContactValues& c) { c.friction = -0.1; }),
          {"boundary: contact: friction: -0.1"});
}

}  // namespace
}  // namespace airybench::wall_test
