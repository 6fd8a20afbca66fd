// Which triangles are refined, on made-up errors; what is expected of finer meshes, where they
// follow a law.
#include "verify/expected_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_meshes.hpp"

namespace airybench::expected_parts_test {
namespace {

std::array<Eigen::Vector2d, 3> corners_of(const Mesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}
double area_of(const std::array<Eigen::Vector2d, 3>& x) { return cross_area(x[0], x[1], x[2]) / 2; }

// e_T² = r^−s A³, r the distance of the centroid from a point.
std::vector<double> parts_of(const Mesh& mesh, double s, const Eigen::Vector2d& from) {
  std::vector<double> parts;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto x = corners_of(mesh, t);
    parts.push_back(std::pow(((x[0] + x[1] + x[2]) / 3 - from).norm(), -s) *
                    std::pow(area_of(x), 3));
  }
  return parts;
}

double sum(const std::vector<double>& parts) {
  double total = 0;
  for (const double part : parts) total += part;
  return total;
}

// From the middle of the longest edge.
std::array<std::array<Eigen::Vector2d, 3>, 2> halves(const std::array<Eigen::Vector2d, 3>& x) {
  int k = 0;
  for (const int other : {1, 2})
    if ((x[(other + 1) % 3] - x[other]).norm() > (x[(k + 1) % 3] - x[k]).norm()) k = other;
  const Eigen::Vector2d middle = (x[k] + x[(k + 1) % 3]) / 2;
  return {{{x[k], middle, x[(k + 2) % 3]}, {middle, x[(k + 1) % 3], x[(k + 2) % 3]}}};
}

TEST(ExpectedParts, OfASmoothStressAHalfHasAnEighth) {
  const Mesh mesh = testing::small_block(6, 6, 3);
  const std::vector<double> parts = parts_of(mesh, 0, {0, 0});
  const ExpectedParts expected(mesh, number_edges(mesh), parts);
  for (int t = 0; t < static_cast<int>(parts.size()); ++t) {
    EXPECT_NEAR(expected.of({t, 0, corners_of(mesh, t)}), parts[t], 1e-12 * parts[t]);
    for (const auto& half : halves(corners_of(mesh, t)))
      EXPECT_NEAR(expected.of({t, 1, half}), parts[t] / 8, 1e-12 * parts[t]);
  }
}

// Chords along one side of the block: no vertex is taken for a singular one, and a half has 2^−2.5.
TEST(ExpectedParts, OfChordsAHalfHasMoreThanOfStresses) {
  const Mesh mesh = testing::small_block(6, 6, 3);
  std::vector<double> parts = parts_of(mesh, 0, {0, 0}), chords(parts.size(), 0);
  for (int t = 0; t < static_cast<int>(parts.size()); ++t)
    if (corners_of(mesh, t)[0].x() < 1) parts[t] += chords[t] = 100 * parts[t];
  const ExpectedParts expected(mesh, number_edges(mesh), parts, 1, chords);
  int along = 0;
  for (int t = 0; t < static_cast<int>(parts.size()); ++t) {
    along += chords[t] > 0 ? 1 : 0;
    const double of_half = (parts[t] - chords[t]) / 8 + chords[t] / std::pow(2, 2.5);
    for (const auto& half : halves(corners_of(mesh, t)))
      EXPECT_NEAR(expected.of({t, 1, half}), of_half, 1e-12 * parts[t]);
  }
  EXPECT_GT(along, 0);
  const auto finer = expected.cut_until(
      [&](const ExpectedParts::Finer& now) { return now.squared <= sum(parts) / 100; });
  EXPECT_GT(finer.triangles, 0.95 * std::pow(100, 1 / 1.5) * along);  // η² ~ N^−1.5
}

// A triangle at the vertex; the law holds for all of its parts.
TEST(ExpectedParts, AtASingularVertexTheLawOfTheStressIsFound) {
  const Mesh mesh = testing::small_block(8, 8, 0);
  const int v = mesh.triangles[40][0];
  for (const double lambda : {0.5, 0.7, 1.2}) {
    const double s = 6 - 2 * lambda;
    const std::vector<double> parts = parts_of(mesh, s, mesh.vertices[v]);
    const ExpectedParts expected(mesh, number_edges(mesh), parts);
    for (int t = 0; t < static_cast<int>(parts.size()); ++t) {
      if (std::ranges::count(mesh.triangles[t], v) == 0) continue;
      auto x = corners_of(mesh, t);
      // Similar triangles that shrink towards the vertex.
      for (auto& corner : x) corner = (corner + mesh.vertices[v]) / 2;
      EXPECT_NEAR(expected.of({t, 2, x}) / parts[t], std::pow(2, -2 * lambda), 0.2) << lambda;
    }
  }
}

// However flat the triangle is, its parts have less and less: so cutting ends.
TEST(ExpectedParts, PartsOfSliversHaveLessAndLess) {
  Mesh mesh = testing::small_block(8, 8, 0);
  for (Eigen::Vector2d& x : mesh.vertices) x.y() *= 100;
  const std::vector<double> parts = parts_of(mesh, 4.6, mesh.vertices[mesh.triangles[40][0]]);
  const ExpectedParts expected(mesh, number_edges(mesh), parts);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    auto x = corners_of(mesh, t);
    for (int cut = 1; cut < 20; ++cut) {
      x = halves(x)[static_cast<std::size_t>(cut % 2)];
      EXPECT_LE(expected.of({t, cut, x}), 1.001 * std::pow(2, -0.7 * cut) * parts[t]) << cut;
    }
  }
}

TEST(ExpectedParts, CuttingEndsWhereItIsFineEnoughAndLeavesEqualParts) {
  const Mesh mesh = testing::small_block(6, 6, 3);
  for (const double s : {0., 4.8}) {
    const std::vector<double> parts = parts_of(mesh, s, mesh.vertices[mesh.triangles[20][1]]);
    const ExpectedParts expected(mesh, number_edges(mesh), parts);
    const auto finer = expected.cut_until(
        [&](const ExpectedParts::Finer& now) { return now.squared <= sum(parts) / 1000; });
    EXPECT_LE(finer.squared, sum(parts) / 1000);
    EXPECT_GT(finer.squared, sum(parts) / 4000);
    // The mesh that is cut below the threshold is as expected, and more for its neighbours.
    const BisectedMesh fine =
        bisected(mesh, [&](const TrianglePart& part) { return expected.of(part) > finer.largest; });
    const auto triangles = static_cast<double>(fine.mesh.triangles.size());
    EXPECT_GE(triangles, 0.9 * finer.triangles) << s;
    EXPECT_LE(triangles, 1.8 * finer.triangles) << s;
  }
  const ExpectedParts none(mesh, number_edges(mesh), std::vector<double>(mesh.triangles.size(), 0));
  const auto same = none.cut_until([](const ExpectedParts::Finer&) { return false; });
  EXPECT_EQ(same.triangles, static_cast<double>(mesh.triangles.size()));
}

TEST(BulkMarks, AreTheFewestThatHoldTheFraction) {
  const std::vector<double> parts = {1, 5, 0, 3, 1};
  EXPECT_EQ(bulk_marks(parts, 0.5), (std::vector{1}));
  EXPECT_EQ(bulk_marks(parts, 0.51), (std::vector{1, 3}));
  EXPECT_EQ(bulk_marks(parts, 0.85), (std::vector{0, 1, 3}));  // of equal parts the lower number
  EXPECT_EQ(bulk_marks(parts, 1), (std::vector{0, 1, 3, 4}));
}

TEST(BulkMarks, PartsThatRoundingMadeNegativeAreZero) {
  EXPECT_EQ(bulk_marks({-1e-18, 1, 1}, 1), (std::vector{1, 2}));
  EXPECT_EQ(bulk_marks({0, -1e-18}, 0.6), std::vector<int>());
}

}  // namespace
}  // namespace airybench::expected_parts_test
