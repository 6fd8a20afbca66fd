// A body that overlaps itself, and outlines that only look so.
#include "mesh/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/mesh_checks.hpp"

namespace airybench::outline_test {
namespace {

using testing::complaint;
using Points = std::vector<Eigen::Vector2d>;
using Edges = std::array<PolygonEdge, 2>;

TEST(Outline, IsSimpleOrNot) {
  EXPECT_FALSE(where_they_meet({{{0, 0}, {1, 0}, {0, 1}}}));
  EXPECT_FALSE(where_they_meet({{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}}));  // straight on
  for (const Points& polygon : {
           Points{{0, 0}, {2, 2}, {2, 0}, {0, 2}},                  // crosses
           Points{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}},          // a corner on an edge
           Points{{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}},  // two corners in one place
           Points{{0, 0}, {4, 0}, {2, 0}, {2, 2}, {0, 2}},          // folds back
           Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, -1}},         // ends in its beginning
       })
    EXPECT_TRUE(where_they_meet({polygon}));
  EXPECT_EQ(where_they_meet({{{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}}}),
            (Edges{PolygonEdge{0, 0}, {0, 2}}));
}

TEST(Outline, SeveralPolygonsMeetOrNot) {
  const Points square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole = {{1, 1}, {1, 3}, {3, 3}};
  const auto moved = [](Points polygon, double x, double y) {
    for (Eigen::Vector2d& p : polygon) p += Eigen::Vector2d(x, y);
    return polygon;
  };
  EXPECT_FALSE(where_they_meet({square, hole}));
  EXPECT_FALSE(where_they_meet({square, hole, moved(hole, 3, 0), moved(hole, 3, 4)}));
  EXPECT_EQ(where_they_meet({square, hole, moved(hole, 7, 0)}), (Edges{PolygonEdge{0, 1}, {2, 1}}))
      << "crosses the first one";
  const auto corners = where_they_meet({square, moved(hole, 4, 0), hole, moved(hole, 2, 2)});
  ASSERT_TRUE(corners) << "a corner in the place of a corner";
  EXPECT_EQ(corners->front().polygon, 2);
  EXPECT_EQ(corners->back().polygon, 3);
  EXPECT_TRUE(where_they_meet({square, hole, hole}));
  EXPECT_TRUE(where_they_meet({square, moved(hole, -1, 0)})) << "an edge on an edge";
}

// On outlines and pairs of outlines, of which many cross and many do not.
TEST(Outline, TheTreeFindsWhatAllPairsFind) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(0, 1);
  const auto polygon_about = [&](double x, int n, double disorder) {
    Points polygon;
    for (int i = 0; i < n; ++i) {
      const double at = 2 * std::numbers::pi * (i + disorder * any(engine)) / n;
      const double r = 1 + any(engine);
      polygon.emplace_back(x + r * std::cos(at), r * std::sin(at));
    }
    return polygon;
  };
  int simple = 0;
  constexpr int outlines = 2000;
  for (int k = 0; k < outlines; ++k) {
    std::vector<Points> polygons;
    for (int count = 1 + k / 2 % 2; count > 0; --count)
      polygons.push_back(polygon_about(3.6 * count, 4 + k % 29, k % 2 == 0 ? 0.9 : 2));
    struct Segment {
      Eigen::Vector2d a, b;
      std::size_t polygon, corner;
    };
    std::vector<Segment> edges;
    for (std::size_t p = 0; p < polygons.size(); ++p)
      for (std::size_t i = 0; i < polygons[p].size(); ++i)
        edges.push_back({polygons[p][i], polygons[p][(i + 1) % polygons[p].size()], p, i});
    const auto parts = [](const Segment& line, const Segment& s) {
      return (cross_area(line.a, line.b, s.a) > 0) != (cross_area(line.a, line.b, s.b) > 0);
    };
    const auto are_neighbours = [&](const Segment& s, const Segment& t) {
      const std::size_t n = polygons[s.polygon].size();
      return s.polygon == t.polygon &&
             ((s.corner + 1) % n == t.corner || (t.corner + 1) % n == s.corner);
    };
    bool crosses = false;
    for (const Segment& s : edges)
      for (const Segment& t : edges)
        crosses |= &s != &t && !are_neighbours(s, t) && parts(s, t) && parts(t, s);
    EXPECT_EQ(where_they_meet(polygons).has_value(), crosses) << k;
    simple += !crosses;
  }
  EXPECT_GT(simple, outlines / 10);
  EXPECT_LT(simple, outlines - outlines / 10);
}

// A strip of squares from angle 0 on, of inner radius 1, that goes round the origin; or whose end
// is its beginning.
Mesh ring_of(double turns, double pitch, bool is_closed = false) {
  Mesh mesh;
  mesh.name = "ring";
  mesh.body_names = {"body"};
  const int cells = static_cast<int>(std::lround(16 * turns));
  for (int i = 0; i < cells + !is_closed; ++i)
    for (int side = 0; side < 2; ++side) {
      const double at = 2 * std::numbers::pi * (i % 16) / 16, r = 1 + side + pitch * i / 16;
      mesh.vertices.emplace_back(r * std::cos(at), r * std::sin(at));
    }
  for (int i = 0; i < cells; ++i) {
    const int a = 2 * i, b = is_closed && i == cells - 1 ? 0 : a + 2;
    mesh.triangles.push_back({a, a + 1, b + 1});
    mesh.triangles.push_back({a, b + 1, b});
    mesh.boundary.push_back({{a + 1, b + 1}, BoundaryRole::displacement});
    mesh.boundary.push_back({{b, a}, BoundaryRole::force});
  }
  if (!is_closed) {
    mesh.boundary.push_back({{0, 1}, BoundaryRole::force});
    mesh.boundary.push_back({{2 * cells + 1, 2 * cells}, BoundaryRole::force});
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  return mesh;
}

TEST(Overlap, IsRefused) {
  EXPECT_NO_THROW(validate(ring_of(0.75, 0)));
  EXPECT_NO_THROW(validate(ring_of(2, 1.5))) << "a spiral, whose turns are apart";
  for (const auto& [turns, pitch] : {std::pair(1.5, 0.0), {1.5, 0.5}, {1.5, 1.0}, {1.0, 0.0}})
    EXPECT_NE(complaint(ring_of(turns, pitch)).find("; the body must not overlap itself"),
              std::string::npos)
        << turns << " turns, pitch " << pitch;
}

TEST(Overlap, OfARingThatIsClosed) {
  EXPECT_EQ(complaint(ring_of(1, 0, true)), "no complaint");
  EXPECT_EQ(hole_count(ring_of(1, 0, true)), 1);
  EXPECT_EQ(
      complaint(ring_of(2, 0, true)),
      "ring: boundary edge 1-63 at [0.96194, -0.191342]: crosses or touches boundary edge 35-33 "
      "at [0.96194, 0.191342]; the body must not overlap itself: vertices 1 and 33 are two "
      "in one place, [1, 0] (allowed: one, where elements are joined)");
}

// Two squares on one another, the upper one smaller, both slit along the same two edges and each
// side of one slit glued to the other side of the other: no boundary meets another.
TEST(Overlap, OfTwoSheetsWithoutBoundariesThatMeet) {
  Mesh mesh;
  mesh.name = "sheets";
  mesh.body_names = {"body"};
  std::map<std::array<int, 3>, int> number;  // of sheet, column, row
  const auto vertex = [&](int sheet, int i, int j) {
    const auto [entry, is_new] =
        number.try_emplace({sheet, i, j}, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.emplace_back(i, j);
    return entry->second;
  };
  // The slit goes from (3, 2) by (3, 3) to (3, 4); left of it the ends of an edge there are those
  // of the sheet, right of it those of the other one.
  const auto corner = [&](int sheet, int cell, int i, int j) {
    if (i == 3 && (j == 2 || j == 4)) return vertex(0, i, j);
    if (i == 3 && j == 3) return vertex(cell < 3 ? sheet : 1 - sheet, i, j);
    return vertex(sheet, i, j);
  };
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int i = sheet; i < 6 - sheet; ++i)
      for (int j = sheet; j < 6 - sheet; ++j) {
        const int a = corner(sheet, i, i, j), b = corner(sheet, i, i + 1, j),
                  c = corner(sheet, i, i + 1, j + 1), d = corner(sheet, i, i, j + 1);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
  testing::hold_all_around(mesh);
  EXPECT_EQ(mesh.boundary.size(), 4 * 6 + 4 * 4u);
  EXPECT_EQ(complaint(mesh), "sheets: 2 outer boundaries; the body must not overlap itself");
}

}  // namespace
}  // namespace airybench::outline_test
