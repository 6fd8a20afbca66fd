#include "mesh/straight_sides.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <sstream>

#include "mesh/msh_format.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::straight_sides_test {
namespace {

using testing::largest_bend, testing::small_block, testing::with_role;
using Rounding = std::function<double(double)>;

Rounding to_digits(int digits) {
  return [digits](double x) {
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.*g", digits, x);
    return std::strtod(text.data(), nullptr);
  };
}
double to_single(double x) { return static_cast<float>(x); }
double to_fixed_width(double x) { return to_digits(x < 0 ? 6 : 7)(x); }  // Nastran's 8 characters

Mesh rounded(Mesh mesh, const Rounding& to) {
  for (Eigen::Vector2d& vertex : mesh.vertices) vertex = vertex.unaryExpr(to);
  return mesh;
}

Mesh turned(Mesh mesh, double degrees) {
  const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
  for (Eigen::Vector2d& x : mesh.vertices) x = turn * x;
  return mesh;
}

// A block held on all sides, turned: no side along an axis, coordinates of both signs.
Mesh held_block() {
  return with_role(
      with_role(small_block(6, 6, 30), BoundaryRole::force, BoundaryRole::displacement),
      BoundaryRole::contact, BoundaryRole::displacement);
}

double furthest(const Mesh& one, const Mesh& other) {
  double distance = 0;
  for (std::size_t v = 0; v < one.vertices.size(); ++v)
    distance = std::max(distance, (one.vertices[v] - other.vertices[v]).norm());
  return distance;
}

void expect_unchanged(const Mesh& before, const std::string& why) {
  Mesh mesh = before;
  EXPECT_EQ(straighten_sides(mesh).count, 0) << why;
  EXPECT_EQ(furthest(mesh, before), 0) << why;
}

template <typename Chosen>
void expect_same_ends(const Mesh& one, const Mesh& other, Chosen chosen) {
  int edges = 0;
  for (const BoundaryEdge& edge : one.boundary) {
    if (!chosen(edge)) continue;
    ++edges;
    for (const int v : edge.vertices) EXPECT_EQ(one.vertices[v], other.vertices[v]) << v;
  }
  EXPECT_GT(edges, 0);
}

TEST(StraightSides, RoundedCoordinatesBendNoMore) {
  struct Case {
    std::string name;
    Rounding to;
    double rounding_mm;  // half a unit of the last digit of 10
  };
  const std::vector<Case> cases = {{"6 digits", to_digits(6), 5e-5},
                                   {"7 digits", to_digits(7), 5e-6},
                                   {"10 digits", to_digits(10), 5e-9},
                                   {"single precision", to_single, 5e-7},
                                   {"fixed width", to_fixed_width, 5e-5}};
  for (const Case& own : cases) {
    const Mesh before = rounded(held_block(), own.to);
    Mesh mesh = before;
    const MovedVertices moved = straighten_sides(mesh);
    EXPECT_GT(largest_bend(before), 1e-10) << own.name;
    EXPECT_LT(largest_bend(mesh), 1e-12) << own.name;
    EXPECT_GT(moved.count, 10) << own.name;  // of 4 sides with 5 inner vertices
    EXPECT_LE(moved.count, 20) << own.name;
    EXPECT_NEAR(moved.furthest_mm, furthest(mesh, before), 1e-14) << own.name;
    EXPECT_LT(moved.furthest_mm, 3 * own.rounding_mm) << own.name;
  }
}

TEST(StraightSides, MeshFilesAreReadSo) {
  const Mesh before = rounded(held_block(), to_digits(7));
  std::istringstream file(msh_text(before));
  std::vector<std::string> notes;
  const Mesh mesh = read_msh(file, "block.msh", &notes);
  EXPECT_LT(largest_bend(mesh), 1e-12);
  Mesh moved_here = before;
  const MovedVertices moved = straighten_sides(moved_here);
  EXPECT_GT(moved.count, 10);
  const std::string words = "vertices moved onto straight sides: " + std::to_string(moved.count);
  EXPECT_TRUE(moved.words().starts_with(words + ", by up to ")) << moved.words();
  EXPECT_EQ(notes, std::vector{moved.words()});
  std::istringstream again(msh_text(mesh));
  EXPECT_EQ(furthest(read_msh(again, "block.msh"), mesh), 0);
}

TEST(StraightSides, ContactEdgesStay) {
  const Mesh before = rounded(small_block(6, 6, 30), to_digits(7));
  Mesh mesh = before;
  EXPECT_GT(straighten_sides(mesh).count, 10);  // of 15 inner vertices
  expect_same_ends(mesh, before,
                   [](const BoundaryEdge& edge) { return edge.role == BoundaryRole::contact; });
}

// As of a model with rounded points, which Gmsh meshes.
TEST(StraightSides, DigitsAreThoseOfVerticesWhereEdgesBend) {
  Mesh mesh = rounded(held_block(), to_digits(7));
  const std::vector<int> rows = boundary_chains(mesh, BoundaryRole::displacement).at(0);
  const auto [before, inner] = mesh.boundary[rows[0]].vertices;
  const int after = mesh.boundary[rows[1]].vertices[1];
  mesh.vertices[inner] = mesh.vertices[before] / 3 + mesh.vertices[after] * 2 / 3;
  EXPECT_GT(straighten_sides(mesh).count, 10);
  EXPECT_LT(largest_bend(mesh), 1e-12);
}

TEST(StraightSides, DigitsAreOfTheFilesUnit) {
  constexpr double inch = 25.4;
  Mesh mesh = held_block();
  for (Eigen::Vector2d& vertex : mesh.vertices)
    vertex = inch * (vertex / inch).unaryExpr(to_digits(7));
  expect_unchanged(mesh, "17 digits of mm");
  EXPECT_GT(straighten_sides(mesh, inch).count, 10);
  EXPECT_LT(largest_bend(mesh), 1e-12);
}

TEST(StraightSides, WhatNoRoundingExplainsStays) {
  expect_unchanged(held_block(), "full precision");
  Mesh exact = held_block();
  for (Eigen::Vector2d& vertex : exact.vertices) vertex += Eigen::Vector2d(1e-7, 0) * vertex.y();
  exact.vertices[3] += Eigen::Vector2d(1e-9, 1e-9);
  expect_unchanged(exact, "a bump in full precision");
  expect_unchanged(rounded(testing::small_ring(24, 2, 3, 6), to_digits(7)), "a circle");
  expect_unchanged(rounded(small_block(6, 6, 0), to_digits(7)), "sides along the axes");
  using enum BoundaryRole;
  const Mesh flat = {.name = "flat",
                     .vertices = {{0, 0}, {1.234567, 1.234566}, {3, 3}, {0, 4}},
                     .triangles = {{0, 1, 2}, {0, 2, 3}},
                     .triangle_body = {0, 0},
                     .body_names = {"body"},
                     .boundary = {{{0, 1}, displacement},
                                  {{1, 2}, displacement},
                                  {{2, 3}, force},
                                  {{3, 0}, contact}},
                     .boundary_groups = {}};
  validate(flat);
  expect_unchanged(flat, "a triangle flatter than the rounding");
  Mesh arch = with_role(small_block(10, 2, 0), BoundaryRole::force, BoundaryRole::displacement);
  for (Eigen::Vector2d& x : arch.vertices) x = {x.x() + 1e6, x.y() + x.x() * (10 - x.x()) / 100};
  expect_unchanged(arch, "an arch of 0.25 mm that is given to 0.01 mm, 1 km away");
  Mesh chevron = with_role(small_block(6, 6, 0), BoundaryRole::force, BoundaryRole::displacement);
  for (Eigen::Vector2d& x : chevron.vertices) x.y() += 0.1 * std::abs(x.x() - 5);
  expect_unchanged(rounded(chevron, to_digits(4)), "few digits");
}

// The side x = 0 is bent from its middle on, by 7e-4 mm at every vertex.
TEST(StraightSides, OfABentSideItsStraightPart) {
  Mesh mesh = small_block(2, 12, 0);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::displacement && mesh.vertices[edge.vertices[0]].y() > 5)
      edge.group = boundary_group(mesh, "bent");
  for (Eigen::Vector2d& x : mesh.vertices) x.x() += 1e-3 * std::pow(std::max(0.0, x.y() - 5), 2);
  mesh = rounded(turned(mesh, 30), to_digits(7));
  const Mesh before = mesh;
  EXPECT_GE(straighten_sides(mesh).count, 3);
  expect_same_ends(mesh, before, [&](const BoundaryEdge& edge) {
    return boundary_label(mesh, edge) == "displacement:bent";
  });
}

}  // namespace
}  // namespace airybench::straight_sides_test
