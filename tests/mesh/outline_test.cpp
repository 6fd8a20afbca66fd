// A body that overlaps itself, and outlines that only look so.
#include "mesh/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesh/mesh.hpp"

namespace airybench::outline_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(Outline, IsSimpleOrNot) {
  EXPECT_FALSE(where_it_meets_itself({{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(where_it_meets_itself({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));  // straight on
  for (const Points& polygon : {
           Points{{0, 0}, {2, 2}, {2, 0}, {0, 2}},                  // crosses
           Points{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}},          // a corner on an edge
           Points{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}},  // two corners in one place
           Points{{0, 0}, {4, 0}, {2, 0}, {2, 2}, {0, 2}},          // folds back
           Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, -1}},         // ends in its beginning
       })
    EXPECT_TRUE(where_it_meets_itself(polygon));
  const auto found = where_it_meets_itself({{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}});
  EXPECT_EQ(found, (std::array{0, 2}));
}

// Every pair of edges beside the tree, on outlines of which many cross and many do not.
TEST(Outline, TheTreeFindsWhatAllPairsFind) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(0, 1);
  int simple = 0;
  constexpr int polygons = 2000;
  for (int k = 0; k < polygons; ++k) {
    const int n = 4 + k % 29;
    Points polygon;
    for (int i = 0; i < n; ++i) {
      const double at = 2 * std::numbers::pi * (i + (k % 2 == 0 ? 0.9 : 2) * any(engine)) / n;
      polygon.emplace_back((1 + any(engine)) * std::cos(at), (1 + any(engine)) * std::sin(at));
    }
    const auto side = [&](int a, int b, int x) {
      return cross_area(polygon[a % n], polygon[b % n], polygon[x % n]) > 0;
    };
    bool crosses = false;
    for (int i = 0; i < n; ++i)
      for (int j = i + 2; j < n; ++j)
        if (i > 0 || j < n - 1)
          crosses |= side(i, i + 1, j) != side(i, i + 1, j + 1) &&
                     side(j, j + 1, i) != side(j, j + 1, i + 1);
    EXPECT_EQ(where_it_meets_itself(polygon).has_value(), crosses) << k;
    simple += !crosses;
  }
  EXPECT_GT(simple, polygons / 10);
  EXPECT_LT(simple, polygons - polygons / 10);
}

// A strip of squares from angle 0 on, of inner radius 1, that goes round the origin.
Mesh ring_of(double turns, double pitch) {
  Mesh mesh;
  mesh.name = "ring";
  mesh.body_names = {"body"};
  const int cells = static_cast<int>(std::lround(16 * turns));
  for (int i = 0; i <= cells; ++i)
    for (int side = 0; side < 2; ++side) {
      const double at = 2 * std::numbers::pi * (i % 16) / 16, r = 1 + side + pitch * i / 16;
      mesh.vertices.emplace_back(r * std::cos(at), r * std::sin(at));
    }
  for (int i = 0; i < cells; ++i) {
    const int a = 2 * i;
    mesh.triangles.push_back({a, a + 1, a + 3});
    mesh.triangles.push_back({a, a + 3, a + 2});
    mesh.boundary.push_back({{a + 1, a + 3}, BoundaryRole::force});
    mesh.boundary.push_back({{a + 2, a}, BoundaryRole::force});
  }
  mesh.boundary.push_back({{0, 1}, BoundaryRole::displacement});
  mesh.boundary.push_back({{2 * cells + 1, 2 * cells}, BoundaryRole::force});
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  return mesh;
}

TEST(Overlap, IsRefused) {
  EXPECT_NO_THROW(validate(ring_of(0.75, 0)));
  EXPECT_NO_THROW(validate(ring_of(2, 1.5))) << "a spiral, whose turns are apart";
  for (const auto& [turns, pitch] : {std::pair(1.5, 0.0), {1.5, 0.5}, {1.5, 1.0}, {1.0, 0.0}}) {
    try {
      validate(ring_of(turns, pitch));
      ADD_FAILURE() << turns << " turns, pitch " << pitch << ": taken";
    } catch (const MeshError& error) {
      EXPECT_NE(std::string(error.what()).find("; the body must not overlap itself"),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace airybench::outline_test
