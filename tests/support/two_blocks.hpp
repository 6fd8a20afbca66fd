// Two blocks in contact: meshes that do not match, and a scene that presses them together; a plate
// on a wall.
#pragma once

#include <memory>

#include "assembly/problem/scene.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/posed.hpp"

namespace airybench::testing {

// One 12 mm wide on another, with so many edges on each face.
inline Mesh two_blocks(int lower, int upper, const std::string& left = "force") {
  Mesh mesh;
  mesh.name = "blocks";
  const std::string side = left == "force" ? left : left + ":";
  const auto of = [&](const char* body) { return left == "force" ? left : side + body; };
  add_block(mesh, "base", {0, -6}, {12, 0}, lower, 5,
            {"displacement:floor", "force", "contact:base", of("base")});
  add_block(mesh, "block", {0, 0}, {12, 5}, upper, 4,
            {"contact:block", "force", "displacement:head", of("block")});
  validate(mesh);
  return mesh;
}

// The left side of the base is the group contact:side, which faces nothing.
inline Mesh with_contact_beside(Mesh mesh) {
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::force && mesh.vertices[edge.vertices[0]].x() == 0 &&
        mesh.vertices[edge.vertices[0]].y() <= 0 && mesh.vertices[edge.vertices[1]].x() == 0)
      edge = {edge.vertices, BoundaryRole::contact, boundary_group(mesh, "side")};
  return mesh;
}

inline Scene pressed(double friction, const Eigen::Vector2d& head_mm = {0.004, -0.01}) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.materials = {{"base", {70000, 0.33}}, {"block", {210000, 0.3}}};
  scene.contacts = {{.between = {{{"contact:block"}, {"contact:base"}}}, .friction = friction}};
  scene.boundary["displacement:floor"].displacement_mm = LinearValue<Eigen::Vector2d>{};
  scene.boundary["displacement:floor"].displacement_mm->values.fill({0, 0});
  scene.boundary["displacement:head"].displacement_mm =
      LinearValue<Eigen::Vector2d>{{head_mm, head_mm}};
  return scene;
}

// A plate of 1 mm long cells, 4 mm high, pressed on a wall: many contact points at a little cost.
inline std::shared_ptr<const Problem> pressed_plate(int cells) {
  Mesh mesh;
  mesh.name = "plate";
  add_block(mesh, "plate", {0, 0}, {static_cast<double>(cells), 4}, cells, 3,
            {"contact", "force", "displacement:head", "force"});
  Scene scene;
  scene.friction = 0.3;
  scene.wall = FlatWall{{0, 0}, {0, 1}};
  scene.displacement_mm = {0.002, -0.01};
  return posed(scene, mesh);
}

}  // namespace airybench::testing
