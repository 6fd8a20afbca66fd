#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <sstream>

#include "mesh/arcs.hpp"
#include "mesh/bisection.hpp"
#include "mesh/interfaces.hpp"
#include "mesh/mend.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/refinement.hpp"
#include "mesh/supposed_curves.hpp"
#include "mesh/transform.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::curved_sides_test {
namespace {

using std::numbers::pi;
using testing::small_block, testing::small_ring;
using Point = Eigen::Vector2d;

EdgeCurve arc(double radius, double turn_rad) {
  std::vector<Point> points;
  for (int i = 0; i <= EdgeCurve::max_degree; ++i) {
    const double angle = turn_rad * i / EdgeCurve::max_degree;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return EdgeCurve{points};
}

Mesh ring(int around = 24) {
  Mesh mesh = small_ring(around, 2, 1, 3);
  EXPECT_EQ(recognise_arcs(mesh), 2 * around);
  return mesh;
}

// The largest distance of a point of the boundary from the nearer of two circles about the origin.
double off_circles(const Mesh& mesh, double inner_mm, double outer_mm) {
  double largest = 0;
  for (const BoundaryEdge& edge : mesh.boundary)
    for (const double t : {0., 0.1, 0.35, 0.5, 0.9, 1.}) {
      const double r = point_on(mesh, edge, t).norm();
      largest = std::max(largest, std::min(std::abs(r - inner_mm), std::abs(r - outer_mm)));
    }
  return largest;
}

int curved_edges(const Mesh& mesh) {
  return static_cast<int>(std::ranges::count_if(
      mesh.boundary, [](const BoundaryEdge& edge) { return !edge.curve.is_straight(); }));
}

double area_of(const Mesh& mesh) { return extent_of(mesh).area_mm2; }

TEST(EdgeCurve, FollowsAnArcAsItsHeaderSays) {
  const auto error = [](double degrees) {
    const EdgeCurve curve = arc(2, degrees * pi / 180);
    double largest = 0;
    for (int i = 0; i <= 100; ++i)
      largest = std::max(largest, std::abs(curve.at(i / 100.).norm() / 2 - 1));
    return largest;
  };
  EXPECT_LT(error(22.5), 2e-12);
  EXPECT_LT(error(45), 6e-10);
  EXPECT_GT(error(45), 1e-11);
}

TEST(EdgeCurve, PartsAreTheSameCurve) {
  const EdgeCurve whole = arc(1, 1);
  for (const auto& [first, last] : {std::pair(0., 0.5), {0.5, 1.}, {0.2, 0.3}, {0.1, 1.2}}) {
    const EdgeCurve part = whole.between(first, last);
    for (const double s : {0., 0.25, 1.}) {
      const double t = first + s * (last - first);
      EXPECT_LT((part.at(s) - whole.at(t)).norm(), 1e-13);
      EXPECT_LT((part.derivative(s) - (last - first) * whole.derivative(t)).norm(), 1e-12);
    }
  }
  EXPECT_EQ(whole.between(0, 0.5).points_mm.back(), whole.at(0.5));
  EXPECT_EQ(whole.between(0.5, 1).points_mm.front(), whole.at(0.5));
}

TEST(EdgeCurve, MeetsALine) {
  const EdgeCurve curve = arc(1, 0.4);
  for (const double angle : {0., 0.15, 0.4, 0.42}) {  // the last beyond its end
    const Point direction(std::cos(angle), std::sin(angle));
    EXPECT_LT((curve.at(curve.parameter_on_line(3 * direction, direction)) - direction).norm(),
              1e-10);
  }
}

TEST(EdgeCurve, SagittaOfAnArc) {
  EXPECT_NEAR(arc(2, 0.5).sagitta(), 2 * (1 - std::cos(0.25)), 1e-9);
  const EdgeCurve parabola = {{{0, 0}, {1, 0.5}, {2, 0}}};
  EXPECT_NEAR(parabola.sagitta(), 0.5, 1e-12);
}

// Half the turning angle of a hole's side must stay below the angle between chord and spoke, 30° in
// an equilateral triangle.
TEST(EdgeCurve, FitsATriangleUntilItHidesAPartOfItself) {
  const auto fits_at = [](double half_turn_degrees) {
    const double half = half_turn_degrees * pi / 180;
    EdgeCurve hole;  // of radius 1 about the origin, the body above it, walked to the right
    for (Point p : arc(1, 2 * half).points_mm) {
      p = Eigen::Rotation2Dd(pi / 2 - half) * p;
      hole.points_mm.emplace_back(-p.x(), p.y());
    }
    const double length = hole.chord().norm();
    return fits(hole, (hole.points_mm.front() + hole.points_mm.back()) / 2 +
                          Point(0, length * std::sqrt(3) / 2));
  };
  EXPECT_TRUE(fits_at(5));
  EXPECT_TRUE(fits_at(20));
  EXPECT_FALSE(fits_at(30));
  EXPECT_FALSE(fits_at(45));
}

TEST(Arcs, AreFoundInRoundedCoordinates) {
  for (const double unit : {1e-9, 1e-6}) {
    Mesh mesh = small_ring(30, 2, 1, 3);
    for (Point& x : mesh.vertices) x = (x / unit).array().round() * unit;
    EXPECT_EQ(recognise_arcs(mesh), 60) << unit;
    EXPECT_LT(off_circles(mesh, 1, 3), 3 * unit) << unit;
    validate(mesh);
  }
}

TEST(Arcs, AreNoCornersNoEllipsesAndNoCoarsePolygons) {
  const auto none = [](Mesh mesh) { return recognise_arcs(mesh) == 0; };
  EXPECT_TRUE(none(small_block(6, 6, 30)));
  EXPECT_TRUE(none(small_ring(11, 2, 1, 3)));
  Mesh ellipse = small_ring(40, 2, 1, 3);
  for (Point& x : ellipse.vertices) x.y() *= 0.9;
  EXPECT_TRUE(none(ellipse));
  Mesh bent = small_ring(24, 2, 1, 3);  // every fourth vertex off by more than rounding
  for (std::size_t v = 0; v < bent.vertices.size(); v += 4) bent.vertices[v] *= 1 + 1e-9;
  EXPECT_TRUE(none(bent));
}

// A ring of parabolas whose middles are moved outwards from the circle by this part.
Mesh of_parabolas(int around, double off) {
  Mesh mesh = small_ring(around, 2, 1, 3);
  for (BoundaryEdge& edge : mesh.boundary) {
    const Point &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    const Point middle = (1 + off) * a.norm() * (a + b).normalized();
    edge.curve = EdgeCurve{{a, middle, b}};
  }
  return mesh;
}

TEST(Arcs, AreFoundOnSidesOfQuadraticElements) {
  for (const int around : {8, 24}) {
    Mesh mesh = of_parabolas(around, 0);
    EXPECT_GT(off_circles(mesh, 1, 3), 1e-5);
    EXPECT_EQ(recognise_arcs(mesh), 2 * around);
    EXPECT_LT(off_circles(mesh, 1, 3), around > 8 ? 1e-11 : 3e-9);
    Mesh flatter = of_parabolas(around, 1e-6);
    EXPECT_EQ(recognise_arcs(flatter), 0);
  }
  Mesh coarse = of_parabolas(7, 0);
  EXPECT_EQ(recognise_arcs(coarse), 0);
}

// Groups meet within the circle; arcs of fewer than four edges stay chords.
TEST(Arcs, AreOfOneGroup) {
  Mesh mesh = small_ring(24, 2, 1, 3);
  int left = 3;
  for (const std::vector<int>& chain : boundary_chains(mesh, BoundaryRole::force))
    for (const int row : chain)
      if (left-- > 0) mesh.boundary[row].group = boundary_group(mesh, "port");
  EXPECT_EQ(recognise_arcs(mesh), 48 - 3);
  for (const BoundaryEdge& edge : mesh.boundary)
    EXPECT_EQ(edge.curve.is_straight(), boundary_label(mesh, edge) == "force:port");
}

TEST(CurvedSides, AreFollowedByRefinement) {
  const Mesh coarse = ring();
  const double area = pi * (9 - 1);
  const auto expect_followed = [&](const Mesh& mesh, int edges, double gain) {
    validate(mesh);
    EXPECT_LT(off_circles(mesh, 1, 3), 1e-11);
    EXPECT_GE(curved_edges(mesh), edges);
    EXPECT_LT(std::abs(area_of(mesh) - area), std::abs(area_of(coarse) - area) / gain);
  };
  expect_followed(uniformly_refined(uniformly_refined(coarse)), 4 * 48, 15);
  expect_followed(bisected(coarse, std::vector(coarse.triangles.size(), 4)).mesh, 2 * 48, 4);
}

TEST(CurvedSides, FollowAStretchedMesh) {
  MeshTransform twice;
  twice.refine = 2;
  twice.scale = 5;
  twice.stretch = {1, 0.5};
  twice.move_mm = {100, 7};
  const Mesh mesh = transformed(ring(), twice);
  validate(mesh);
  for (const BoundaryEdge& edge : mesh.boundary)
    for (const double t : {0., 0.4, 1.}) {
      const Point x = point_on(mesh, edge, t) - Point(100, 7);
      const double r = std::hypot(x.x() / 5, x.y() / 2.5);
      EXPECT_LT(std::min(std::abs(r - 1), std::abs(r - 3)), 1e-11);
    }
}

TEST(CurvedSides, AreForgottenWhereAPolygonIsMeant) {
  MeshTransform polygon;
  polygon.polygon = true;
  polygon.refine = 1;
  const Mesh mesh = transformed(ring(), polygon);
  EXPECT_EQ(curved_edges(mesh), 0);
  EXPECT_TRUE(supposed_curves(mesh).empty());
  EXPECT_NEAR(area_of(mesh), area_of(ring()), 1e-12);
}

// A ring whose hole has twelve sides, with a vertex put into the triangle on one of them, so far
// from the middle of its chord.
Mesh ring_with_thin_triangle(double from_chord_mm) {
  Mesh mesh = small_ring(12, 2, 1, 3);
  int hole = 0;
  while (boundary_label(mesh, mesh.boundary[hole]) != "force:hole") ++hole;
  const auto [a, b] = mesh.boundary[hole].vertices;
  const MeshEdges edges = number_edges(mesh);
  int t = 0, k = 0;
  for (int of = 0; of < static_cast<int>(mesh.triangles.size()); ++of)
    for (int side = 0; side < 3; ++side)
      if (edges.of_triangle[of][side] == edges.of_boundary[hole]) {
        t = of;
        k = side;
      }
  const Point middle = (mesh.vertices[a] + mesh.vertices[b]) / 2;
  split_at_point(mesh, t, k, middle + from_chord_mm * middle.normalized());
  return mesh;
}

TEST(CurvedSides, OfThinTrianglesAreCut) {
  Mesh mesh = ring_with_thin_triangle(0.12);
  const std::size_t before = mesh.triangles.size();
  const std::vector<std::string> notes = mend(mesh);
  validate(mesh);
  EXPECT_GT(mesh.triangles.size(), before);
  EXPECT_LT(off_circles(mesh, 1, 3), 1e-10);
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return note.starts_with("triangles too thin for their curved edge");
  }));
}

// The arc would leave its triangle at the start of a spoke; only the rim is round then.
TEST(CurvedSides, ThatFitNoTriangleStayChords) {
  Mesh mesh = ring_with_thin_triangle(0.065);
  const std::vector<std::string> notes = mend(mesh);
  EXPECT_EQ(curved_edges(mesh), 12);
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_TRUE(notes[0].ends_with("taken for arcs: 12")) << notes[0];
  EXPECT_TRUE(notes[1].starts_with("curved sides, which refinement follows: displacement:rim"))
      << notes[1];
  EXPECT_NE(notes[2].find("they stay polygons"), std::string::npos) << notes[2];
  EXPECT_NE(notes[2].find("force:hole (12 edges"), std::string::npos) << notes[2];
}

TEST(CurvedSides, ThatCannotBeAreRefused) {
  const auto complaint = [](std::vector<Point> inside) {
    Mesh mesh = small_block(2, 2, 0);
    mesh.name = "block";
    BoundaryEdge& edge = mesh.boundary[0];
    const Point a = mesh.vertices[edge.vertices[0]], b = mesh.vertices[edge.vertices[1]];
    const Point along = b - a, left(-along.y(), along.x());
    edge.curve.points_mm = {a};
    for (const Point& p : inside)
      edge.curve.points_mm.emplace_back(a + p.x() * along + p.y() * left);
    edge.curve.points_mm.push_back(b);
    return testing::complaint_of<MeshError>([&] { mend(mesh); });
  };
  for (const std::vector<Point>& inside : {std::vector{Point(0.5, 5)},
                                           {Point(0.5, 1e300)},
                                           {Point(300, -0.1)},
                                           {Point(1.3, 0.4), Point(0.5, 0.9), Point(-0.3, 0.4)}}) {
    const std::string text = complaint(inside);
    EXPECT_TRUE(text.starts_with("block: boundary edge ")) << text;
    EXPECT_NE(text.find("its curve does not stay on its side of vertex "), text.npos) << text;
  }
  EXPECT_EQ(complaint({Point(0.5, -0.2)}), "no complaint");
  EXPECT_EQ(complaint({Point(0.5, 0.1)}), "no complaint");
}

TEST(CurvedSides, AreWrittenAndRead) {
  const Mesh mesh = ring();
  const std::string text = msh_text(mesh);
  std::istringstream in(text);
  std::vector<std::string> notes;
  const Mesh back = read_msh(in, "ring.msh", &notes);
  ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(curved_edges(back), 48);
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    const EdgeCurve &one = mesh.boundary[row].curve, &other = back.boundary[row].curve;
    EXPECT_EQ(one.points_mm, other.points_mm);
  }
  EXPECT_EQ(mesh.triangles, back.triangles);
  EXPECT_EQ(msh_text(back), text);
  ASSERT_EQ(notes.size(), 1U);  // nothing was taken for an arc
  EXPECT_NE(notes[0].find("force:hole (24 edges, chords off by up to 0.0086 mm)"),
            std::string::npos)
      << notes[0];
}

// Nodes inside lines may come anywhere in the file.
TEST(CurvedSides, OfOtherWritersAreRead) {
  std::istringstream in(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"displacement\"\n1 2 "
      "\"force:arc\"\n2 3 \"body\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n9 0.5 -0.1 0\n2 1 0 "
      "0\n3 "
      "0 1 0\n$EndNodes\n$Elements\n4\n1 8 2 2 2 1 2 9\n2 1 2 1 1 2 3\n3 1 2 1 1 3 1\n4 2 2 3 3 1 "
      "2 "
      "3\n$EndElements\n");
  const Mesh mesh = read_msh(in, "one.msh");
  EXPECT_EQ(mesh.vertices.size(), 3U);
  ASSERT_EQ(mesh.boundary[0].curve.degree(), 2);
  EXPECT_LT((mesh.boundary[0].curve.at(0.5) - Point(0.5, -0.1)).norm(), 1e-15);
}

TEST(SupposedCurves, ArePolygonsThatBendEvenly) {
  Mesh ellipse = small_ring(40, 2, 1, 3);
  for (Point& x : ellipse.vertices) x.y() *= 0.7;
  const std::vector<SupposedCurve> curves = supposed_curves(ellipse);
  EXPECT_EQ(curves.size(), 80U);
  for (const SupposedCurve& curve : curves) {
    EXPECT_LT(curve.from_rad, 0);
    EXPECT_GT(curve.to_rad, 0);
    EXPECT_NEAR(curve.to_rad - curve.from_rad, 2 * pi / 40, 0.08);
  }
  EXPECT_TRUE(supposed_curves(ring()).empty());  // known
  EXPECT_TRUE(supposed_curves(small_block(6, 6, 30)).empty());
  EXPECT_TRUE(supposed_curves(small_ring(8, 2, 1, 3)).empty());  // 45° each
}

TEST(Interfaces, HaveTheFirstBodyOnTheirLeftAndNoBranches) {
  Mesh mesh = small_block(6, 6, 0);
  const auto centroid = [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return Point((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
  };
  EXPECT_TRUE(interfaces(mesh, number_edges(mesh)).empty());
  mesh.body_names = {"below", "above"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangle_body[t] = centroid(t).y() < 5 ? 0 : 1;
  const std::vector<Interface> found = interfaces(mesh, number_edges(mesh));
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].sides.size(), 6U);
  ASSERT_EQ(found[0].line.boundary.size(), 6U);
  EXPECT_EQ(found[0].line.vertices.size(), 7U);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [a, b] = found[0].line.boundary[k].vertices;
    const auto& [first, second] = found[0].sides[k];
    EXPECT_EQ(mesh.triangle_body[first.triangle], 0);
    EXPECT_EQ(mesh.triangle_body[second.triangle], 1);
    EXPECT_GT(cross_area(found[0].line.vertices[a], found[0].line.vertices[b],
                         centroid(static_cast<std::size_t>(first.triangle))),
              0);
  }
  // Four quarters, two and two alike: their lines cross in the middle.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangle_body[t] = (centroid(t).x() < 5) == (centroid(t).y() < 5) ? 0 : 1;
  const std::vector<Interface> crossing = interfaces(mesh, number_edges(mesh));
  ASSERT_EQ(crossing.size(), 1U);
  EXPECT_EQ(crossing[0].sides.size(), 8U);
}

TEST(SupposedCurves, KnowTheirSidesWhenTheseAreCut) {
  Mesh ellipse = small_ring(40, 2, 1, 3);
  for (Point& x : ellipse.vertices) x.y() *= 0.7;
  const auto at = [](const Mesh& mesh) {
    double largest = 0, turns = 0;
    for (const SupposedCurve& curve : supposed_curves(mesh)) {
      largest = std::max(largest, curve.side_mm);
      turns += curve.to_rad - curve.from_rad;
    }
    return std::pair(largest, turns);
  };
  const auto [side, turns] = at(ellipse);
  const auto [side_of_fine, turns_of_fine] = at(uniformly_refined(ellipse));
  EXPECT_NEAR(side_of_fine, side, 1e-12);
  EXPECT_NEAR(turns_of_fine, turns, 0.05 * turns);  // chains begin within a side
}

}  // namespace
}  // namespace airybench::curved_sides_test
