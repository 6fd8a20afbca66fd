// Bodies and walls of one's own, against closed forms and against each other.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bench/plan/scene_file.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/places.hpp"
#include "tests/support/solved_scene.hpp"

namespace airybench::walls_test {
namespace {

using Eigen::Vector2d;

using Solved = testing::SolvedScene;

// The largest difference from Hertz' pressure under the same load, of an edge's mean where that is
// not near its end, relative to its peak; and the half width.
std::pair<double, double> difference_from_hertz(const Solved& solved) {
  constexpr double R = 8, E = 210000 / (1 - 0.3 * 0.3);
  const ContactPoints& contact = solved.system.contact;
  const Eigen::VectorXd& F_C = solved.solution.F_C;
  const int m = contact.components;
  double P = 0;
  for (int i = 0; i < F_C.size(); i += m) P -= F_C(i);
  const double a = std::sqrt(4 * P * R / (std::numbers::pi * E)),
               p0 = 2 * P / (std::numbers::pi * a);
  double worst = 0;
  for (int p = 0; p < contact.count; p += 2) {
    const auto [start, end] = solved.problem().mesh.boundary[contact.boundary[p]].vertices;
    const Vector2d &from = solved.problem().mesh.vertices[start],
                   &to = solved.problem().mesh.vertices[end];
    const double x = (from.x() + to.x()) / 2,
                 pressure = -(F_C(m * p) + F_C(m * (p + 1))) / (to - from).norm();
    if (std::abs(x) < 0.9 * a)
      worst = std::max(worst, std::abs(pressure / p0 - std::sqrt(1 - x * x / (a * a))));
  }
  return {worst, a};
}

// docs/bodies: the mesh of cylinder.geo. As a polygon it bears on its vertices, which finer edges
// show, unless the scene or its mesh says that it is round.
TEST(Walls, ACylinderOfStraightEdgesIsHertzsWhereItsFaceIsSaidToBeRound) {
  Scene scene = read_scene(testing::source_folder() / "docs/bodies/cylinder.json");
  scene.mesh.polygon = true;
  const Mesh mesh = read_msh(testing::test_data("validation/cylinder.msh"));
  const Solved round(scene, mesh, "HYBRID");
  const auto [off, a] = difference_from_hertz(round);
  EXPECT_NEAR(a, 0.28, 0.01);
  EXPECT_LT(off, 0.01);
  const ConstitutiveError error = round.recovered_error();
  EXPECT_TRUE(error.guaranteed) << error.flaw;
  EXPECT_LT(error.relative, 0.03);
  scene.mesh.refine = 2;
  const double off_finer = difference_from_hertz(Solved(scene, mesh, "HYBRID")).first;
  EXPECT_LT(off_finer, off);
  scene.face.reset();
  EXPECT_GT(difference_from_hertz(Solved(scene, mesh, "HYBRID")).first, 10 * off_finer);
  scene.mesh.polygon = false;
  const Solved of_arcs(scene, mesh, "HYBRID");
  EXPECT_LT(difference_from_hertz(of_arcs).first, 1.1 * off_finer);
  EXPECT_FALSE(of_arcs.recovered_error().guaranteed);
}

// A ring from 24 to 30 mm over 120°, its outer side contact, its ends held.
Mesh ring_segment(int radial, int around) {
  Mesh mesh;
  mesh.name = "ring";
  mesh.body_names = {"ring"};
  const int right = boundary_group(mesh, "right"), left = boundary_group(mesh, "left");
  for (int i = 0; i <= around; ++i)
    for (int k = 0; k <= radial; ++k) {
      const double angle = std::numbers::pi * (7. / 6 + 2. / 3 * i / around),
                   r = 24 + 6. * k / radial;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  const auto vertex = [&](int i, int k) { return i * (radial + 1) + k; };
  using enum BoundaryRole;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < radial; ++k) {
      mesh.triangles.push_back({vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1)});
      mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i + 1, k)});
    }
    mesh.boundary.push_back({{vertex(i, radial), vertex(i + 1, radial)}, contact});
    mesh.boundary.push_back({{vertex(i + 1, 0), vertex(i, 0)}, force});
  }
  for (int k = 0; k < radial; ++k) {
    mesh.boundary.push_back({{vertex(around, k + 1), vertex(around, k)}, displacement, right});
    mesh.boundary.push_back({{vertex(0, k), vertex(0, k + 1)}, displacement, left});
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  validate(mesh);
  return mesh;
}

Scene socket(double radius_mm) {
  Scene scene;
  scene.wall = CircularWall{{0, 0}, radius_mm, CircularWall::Bodies::inside};
  scene.face = CircularWall{{0, 0}, 30, CircularWall::Bodies::inside};
  scene.friction = 0;
  return scene;
}

// The ends free to slide, too.
Scene socket_to_slide_in(double radius_mm) {
  Scene scene = socket(radius_mm);
  for (const char* end : {"displacement:left", "displacement:right"})
    scene.boundary[end].support = BoundaryValues::Support::normal;
  scene.displacement_mm = {0, 0};
  return scene;
}

TEST(Walls, ARingTurnsInItsSocketWithoutStress) {
  const Mesh mesh = ring_segment(2, 16);
  Scene scene = socket(30);
  constexpr double angle = 1e-3;
  const auto turned = [&](const Vector2d& x) { return Vector2d(-angle * x.y(), angle * x.x()); };
  for (const auto& [label, degrees] :
       {std::pair("displacement:right", -30.), {"displacement:left", 210.}}) {
    const double a = degrees / 180 * std::numbers::pi;
    const Vector2d in = 24 * Vector2d(std::cos(a), std::sin(a)), out = in * 30 / 24;
    scene.boundary[label].displacement_mm =
        LinearValue<Vector2d>{{turned(in), turned(out)}, {in, out}};
  }
  Scene pressed = scene;
  pressed.wall = CircularWall{{0, 0}, 29.999, CircularWall::Bodies::inside};
  const double size = Solved(pressed, mesh, "HYBRID").energy();
  for (const Method& method :
       select_methods(testing::hybrid_of_every_degree() + ",P2,P3,P4,BLIND:SCHUR"))
    EXPECT_LT(Solved(scene, mesh, method.name).energy(), 1e-20 * size) << method.name;
}

// Of the mean pressures of edges: largest over least, less 1.
double spread_of_pressure(const Solved& solved) {
  const ContactPoints& contact = solved.system.contact;
  double least = 1e9, largest = 0;
  for (int p = 0; p < contact.count; p += contact.per_edge) {
    const auto [a, b] = solved.problem().mesh.boundary[contact.boundary[p]].vertices;
    const auto& x = solved.problem().mesh.vertices;
    const double pressure =
        -solved.solution.F_C.segment(p, contact.per_edge).sum() / (x[b] - x[a]).norm();
    least = std::min(least, pressure);
    largest = std::max(largest, pressure);
  }
  EXPECT_GT(least, 0);
  return largest / least - 1;
}

TEST(Walls, ARingSlidesAlongItsSocketAsFinerOnesDo) {
  // Pressed from inside, its ends free to slide: a uniform pressure, the nearer the finer.
  Scene scene = socket_to_slide_in(30.001);
  scene.boundary["force"].pressure_MPa = LinearValue<double>{{40, 40}};
  for (int k = 1; k <= highest_degree; ++k) {
    const std::string method = hybrid_of_degree(k);
    const double coarse = spread_of_pressure({scene, ring_segment(2, 24), method}),
                 fine = spread_of_pressure({scene, ring_segment(4, 48), method});
    EXPECT_LT(fine, 0.7 * coarse) << method;
    EXPECT_LT(fine, k == 1 ? 0.02 : 2e-4) << method;
  }
}

TEST(Walls, ARoundWallHasNoStrictBoundsAndNoFalseCrossingOfThem) {
  const Scene scene = socket_to_slide_in(29.99);
  for (int k = 1; k <= highest_degree; ++k) {
    const std::string method = hybrid_of_degree(k);
    const ConstitutiveError error = Solved(scene, ring_segment(2, 24), method).recovered_error();
    EXPECT_EQ(error.flaw, "") << method;
    EXPECT_FALSE(error.guaranteed) << method;
    EXPECT_GT(error.relative, 0) << method;
    EXPECT_LT(error.relative, 0.05) << method;
  }
}

TEST(Walls, ATurnedBlockOnAFlatWallIsTheOneOnItsOwnFace) {
  for (const char* method : {"HYBRID", "P2", "P3", "3STEPD"}) {
    Scene own;
    own.crown_radius_mm.reset();
    const Solved expected(own, testing::small_block(4, 4, 0), method);
    const Eigen::Matrix2d turn =
        Eigen::Rotation2Dd(33. / 180 * std::numbers::pi).toRotationMatrix();
    Scene scene;
    scene.wall = FlatWall{turn * Vector2d(10, 3), turn * Vector2d(-1, 0)};
    scene.displacement_mm = turn * own.displacement_mm;
    const Solved turned(scene, testing::small_block(4, 4, 33), method);
    EXPECT_NEAR(turned.energy() / expected.energy(), 1, 1e-11) << method;
    EXPECT_LT(testing::force_error(turned.solution, expected.solution), 1e-11) << method;
  }
}

TEST(Walls, EachGroupSlipsByItsOwnFriction) {
  Mesh block = testing::small_block(6, 6, 0);
  const int upper = boundary_group(block, "upper");
  for (BoundaryEdge& edge : block.boundary)
    if (edge.role == BoundaryRole::contact && block.vertices[edge.vertices[0]].y() > 4.9)
      edge.group = upper;
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0.01, 0.02};
  scene.boundary["contact:upper"].contact.friction = 0;
  for (const char* method : {"HYBRID", "3STEPD", "BLIND:SCHUR", "ALM:AUTO"}) {
    const Solved solved(scene, block, method);
    const ContactPoints& contact = solved.system.contact;
    const Eigen::VectorXd& F = solved.solution.F_C;
    const double size = F.cwiseAbs().maxCoeff();
    double largest_ratio = 0;
    for (int p = 0; p < contact.count; ++p) {
      const bool free =
          boundary_label(block, block.boundary[contact.boundary[p]]) == "contact:upper";
      if (free) {
        EXPECT_EQ(F(2 * p + 1), 0) << method;
      }
      EXPECT_LE(std::abs(F(2 * p + 1)), -contact.friction_at(p) * F(2 * p) + 1e-7 * size) << method;
      if (!free && F(2 * p) < -0.01 * size)
        largest_ratio = std::max(largest_ratio, std::abs(F(2 * p + 1) / F(2 * p)));
    }
    EXPECT_NEAR(largest_ratio, 0.2, 1e-6) << method;
  }
}

}  // namespace
}  // namespace airybench::walls_test
