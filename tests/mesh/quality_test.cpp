#include "mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace airybench::quality_test {
namespace {

const Eigen::Vector2d origin(0, 0), east(1, 0), apex(0.5, std::sqrt(3.0) / 2), north(0, 1);

TEST(TriangleQuality, OfKnownTriangles) {
  EXPECT_NEAR(smallest_angle_deg(origin, east, apex), 60, 1e-12);
  EXPECT_NEAR(mean_ratio(origin, east, apex), 1, 1e-15);
  EXPECT_NEAR(smallest_angle_deg(origin, east, north), 45, 1e-12);
  EXPECT_NEAR(mean_ratio(origin, east, north), std::sqrt(3.0) / 2, 1e-15);
  const Eigen::Vector2d obtuse(-0.5, std::sqrt(3.0) / 2), flat(2, 0);
  EXPECT_NEAR(smallest_angle_deg(origin, east, obtuse), 30, 1e-12);
  EXPECT_EQ(smallest_angle_deg(origin, east, flat), 0);
  EXPECT_EQ(mean_ratio(origin, east, flat), 0);
  EXPECT_LT(mean_ratio(origin, north, east), 0);  // clockwise
}

TEST(TriangleQuality, DoesNotDependOnSizePlaceOrTheFirstVertex) {
  const Eigen::Vector2d a(3, 4), b(3, 4.002), c(2.999, 4.001);
  EXPECT_NEAR(smallest_angle_deg(a, b, c), 45, 1e-9);
  EXPECT_DOUBLE_EQ(mean_ratio(a, b, c), mean_ratio(b, c, a));
}

TEST(MeshQuality, WorstAndMeanOfTheTriangles) {
  Mesh mesh;
  mesh.vertices = {origin, east, apex, {0.5, -0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};  // equilateral, right isosceles
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_NEAR(quality.smallest_angle_deg, 45, 1e-12);
  EXPECT_NEAR(quality.min_mean_ratio, std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(quality.mean_mean_ratio, (1 + std::sqrt(3.0) / 2) / 2, 1e-15);
}

}  // namespace
}  // namespace airybench::quality_test
