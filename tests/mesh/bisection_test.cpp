#include "mesh/bisection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/quality.hpp"
#include "mesh/refinement.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/places.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::bisection_test {
namespace {

using testing::catalogue_mesh, testing::expect_same_body, testing::small_block,
    testing::small_tooth;

double smallest_angle(const Mesh& mesh) { return mesh_quality(mesh).smallest_angle_deg; }

// One cut of each triangle that is …
std::vector<int> all_of(const Mesh& mesh) { return std::vector<int>(mesh.triangles.size(), 1); }
std::vector<int> only(const Mesh& mesh, const std::vector<int>& marked) {
  std::vector<int> cuts(mesh.triangles.size(), 0);
  for (const int t : marked) cuts[t] = 1;
  return cuts;
}
// … and has a vertex within a distance of a point.
std::vector<int> near(const Mesh& mesh, const Eigen::Vector2d& point, double distance_mm) {
  std::vector<int> cuts;
  for (const auto& triangle : mesh.triangles)
    cuts.push_back(std::ranges::any_of(
        triangle, [&](int v) { return (mesh.vertices[v] - point).norm() <= distance_mm; }));
  return cuts;
}

// Two bodies, named groups on the boundary.
Mesh block() {
  Mesh mesh = small_block(4, 4, 17);
  mesh.body_names = {"root", "tip"};
  for (std::size_t t = 15; t < mesh.triangles.size(); ++t) mesh.triangle_body[t] = 1;
  return mesh;
}

TEST(Bisection, NoMarksNoChange) {
  const Mesh mesh = block();
  const BisectedMesh same = bisected(mesh, only(mesh, {}));
  EXPECT_EQ(same.mesh.vertices, mesh.vertices);
  EXPECT_EQ(same.mesh.triangles, mesh.triangles);
  EXPECT_EQ(same.visits, 0);
}

TEST(Bisection, OneMarkCutsTheTriangleAtTheMiddleOfItsLongestEdge) {
  const Mesh mesh = block();
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Mesh fine = bisected(mesh, only(mesh, {t})).mesh;
    expect_same_body(fine, mesh);
    const auto& old = mesh.triangles[t];
    std::pair<double, Eigen::Vector2d> longest(0, Eigen::Vector2d::Zero());
    for (int k = 0; k < 3; ++k) {
      const auto &a = mesh.vertices[old[k]], &b = mesh.vertices[old[(k + 1) % 3]];
      if ((b - a).norm() > longest.first) longest = {(b - a).norm(), (a + b) / 2};
    }
    EXPECT_TRUE(std::ranges::any_of(fine.triangles[t], [&](int v) {
      return v >= static_cast<int>(mesh.vertices.size()) &&
             (fine.vertices[v] - longest.second).norm() < 1e-12;
    })) << t;
  }
}

TEST(Bisection, AMarkedTrianglesPartsComeFromAsManyCuts) {
  const Mesh mesh = block();
  std::vector<int> cuts(mesh.triangles.size(), 0);
  cuts[5] = 3;
  const Mesh fine = bisected(mesh, cuts).mesh;
  expect_same_body(fine, mesh);
  const auto area = [](const Mesh& of, int t) {
    const auto& [a, b, c] = of.triangles[t];
    return cross_area(of.vertices[a], of.vertices[b], of.vertices[c]) / 2;
  };
  const auto& whole = mesh.triangles[5];
  int parts = 0;
  for (int t = 0; t < static_cast<int>(fine.triangles.size()); ++t) {
    const auto& [a, b, c] = fine.triangles[t];
    const Eigen::Vector2d inside = (fine.vertices[a] + fine.vertices[b] + fine.vertices[c]) / 3;
    bool is_part = true;
    for (int k = 0; k < 3; ++k)
      is_part = is_part &&
                cross_area(mesh.vertices[whole[k]], mesh.vertices[whole[(k + 1) % 3]], inside) > 0;
    parts += is_part;
    EXPECT_TRUE(!is_part || area(fine, t) < 1.001 / 8 * area(mesh, 5));
  }
  EXPECT_GE(parts, 8);
}

TEST(Bisection, TheSameMarksGiveTheSameMesh) {
  const Mesh mesh = catalogue_mesh("Mesh1");
  const std::vector<int> cuts = near(mesh, {10, 3}, 2);
  const Mesh one = bisected(mesh, cuts).mesh, other = bisected(mesh, cuts).mesh;
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.triangles, other.triangles);
}

// Rosenberg and Stenger's bound, over grading by eight orders of magnitude towards two corners.
TEST(Bisection, NoAngleFallsBelowHalfTheSmallestOfTheStart) {
  for (const Mesh& start : {small_tooth(4, 4), block(), catalogue_mesh("Mesh4")}) {
    const std::array<Eigen::Vector2d, 2> corners = {start.vertices.front(), start.vertices.back()};
    Mesh mesh = start;
    for (double distance = 1; distance > 1e-8; distance *= 0.6) {
      for (const Eigen::Vector2d& corner : corners)
        mesh = bisected(mesh, near(mesh, corner, distance)).mesh;
      ASSERT_GE(smallest_angle(mesh), 0.5 * smallest_angle(start)) << distance;
    }
    expect_same_body(mesh, start);
  }
}

TEST(Bisection, AllMarkedAgainAndAgainKeepsItsShapes) {
  const Mesh start = small_tooth(3, 3);
  Mesh mesh = start;
  for (int k = 0; k < 8; ++k) {
    const std::size_t before = mesh.triangles.size();
    mesh = bisected(mesh, all_of(mesh)).mesh;
    EXPECT_GE(mesh.triangles.size(), 2 * before);
  }
  expect_same_body(mesh, start);
  EXPECT_GE(smallest_angle(mesh), 0.5 * smallest_angle(start));
}

// Looks at triangles grow with what is made, not with what is there or with the square of either.
TEST(Bisection, TheWorkIsLinearInTheTrianglesThatAreMade) {
  const Mesh mesh = uniformly_refined(catalogue_mesh("Mesh7"));
  ASSERT_GT(mesh_sizes(mesh).n_phi, 200'000);
  EXPECT_LE(bisected(mesh, near(mesh, {10, 6.25}, 0.01)).visits, 100);
  const BisectedMesh all = bisected(mesh, all_of(mesh));
  const auto before = static_cast<std::int64_t>(mesh.triangles.size()),
             made = static_cast<std::int64_t>(all.mesh.triangles.size()) - before;
  EXPECT_GE(made, before);
  EXPECT_LE(all.visits, 2 * made);
  EXPECT_NO_THROW(validate(all.mesh));
}

TEST(Bisection, ATriangleTooSmallToBeCutIsLeftAndCounted) {
  Mesh mesh = small_tooth(2, 2);
  for (Eigen::Vector2d& x : mesh.vertices) x = 1e-10 * x + Eigen::Vector2d(1e4, 0);
  EXPECT_EQ(bisected(mesh, only(mesh, {0, 1})).too_small, 0);
  for (Eigen::Vector2d& x : mesh.vertices) x += Eigen::Vector2d(9e4, 0);
  const BisectedMesh same = bisected(mesh, only(mesh, {0, 1}));
  EXPECT_EQ(same.too_small, 2);
  EXPECT_EQ(same.mesh.triangles, mesh.triangles);
}

}  // namespace
}  // namespace airybench::bisection_test
