// Bonded faces, zones of several laws on one line, cracks.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/control_points.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/solved_scene.hpp"
#include "verify/verifier.hpp"

namespace airybench::bonded_faces_test {
namespace {

using Eigen::Vector2d;
using Law = ContactPair::Law;
using Solved = testing::SolvedScene;

// Two blocks 12 mm wide on each other, their interface in three parts, whose ends are vertices of
// both: "left", "middle" and "right" of base and of block.
Mesh blocks(const std::array<int, 3>& lower, const std::array<int, 3>& upper) {
  Mesh mesh;
  mesh.name = "blocks";
  const auto add = [&](const std::string& body, double low, double high,
                       const std::array<int, 3>& columns, bool is_upper) {
    const std::array<double, 4> ends = {0, 4, 8, 12};
    const std::array<std::string, 3> parts = {"left", "middle", "right"};
    std::vector<double> x = {0};
    for (std::size_t part = 0; part < 3; ++part)
      for (int i = 1; i <= columns[part]; ++i)
        x.push_back(std::lerp(ends[part], ends[part + 1], double(i) / columns[part]));
    const int first = static_cast<int>(mesh.vertices.size()), nx = static_cast<int>(x.size()) - 1;
    constexpr int ny = 4;
    const auto vertex = [&](int i, int j) { return first + i * (ny + 1) + j; };
    for (const double at : x)
      for (int j = 0; j <= ny; ++j)
        mesh.vertices.emplace_back(at, std::lerp(low, high, double(j) / ny));
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j) {
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
      const std::size_t part = (x[i] + x[i + 1]) / 2 < 4 ? 0 : (x[i] + x[i + 1]) / 2 < 8 ? 1 : 2;
      const std::string face = "contact:" + parts[part] + " of " + body;
      testing::add_edge(mesh, vertex(i, 0), vertex(i + 1, 0),
                        is_upper ? face : "displacement:floor");
      testing::add_edge(mesh, vertex(i + 1, ny), vertex(i, ny), is_upper ? "force:top" : face);
    }
    for (int j = 0; j < ny; ++j) {
      testing::add_edge(mesh, vertex(nx, j), vertex(nx, j + 1), "force:right");
      testing::add_edge(mesh, vertex(0, j + 1), vertex(0, j), "force:left");
    }
    testing::name_body(mesh, body);
  };
  add("base", -6, 0, lower, false);
  add("block", 0, 5, upper, true);
  validate(mesh);
  return mesh;
}

ContactPair pair(const std::string& part, std::optional<Law> law, double friction = 0) {
  ContactPair of_part{
      .between = {{{"contact:" + part + " of block"}, {"contact:" + part + " of base"}}},
      .law = law};
  if (!law) of_part.friction = friction;
  return of_part;
}

Scene on_floor(std::vector<ContactPair> contacts) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.contacts = std::move(contacts);
  scene.displacement_mm = {0, 0};
  scene.boundary["force:top"].traction_MPa = {
      {{Vector2d(8, -30), Vector2d(8, -10)}, {Vector2d(0, 5), Vector2d(12, 5)}}};
  return scene;
}
const std::vector<ContactPair> all_bonded = {pair("left", Law::bonded), pair("middle", Law::bonded),
                                             pair("right", Law::bonded)};

TEST(BondedFaces, OfMeshesThatMatchAreOneBody) {
  const Mesh mesh = blocks({2, 3, 2}, {2, 3, 2});
  const Problem problem = pose(on_floor(all_bonded), mesh);
  EXPECT_EQ(pieces_of(problem.mesh).count, 1);
  EXPECT_EQ(problem.mesh.vertices.size(), mesh.vertices.size() - 8);
  EXPECT_EQ(problem.mesh.boundary.size(), mesh.boundary.size() - 14);
  EXPECT_NO_THROW(validate(problem.mesh));
  EXPECT_EQ(problem.mesh.body_names, mesh.body_names);
}

TEST(BondedFaces, AllMethodsAgreeOnMeshesThatDoNotMatch) {
  for (const Material& upper : {Material{70000, 0.3}, Material{210000, 0.2}}) {
    Scene scene = on_floor(all_bonded);
    scene.materials["block"] = upper;
    const Mesh mesh = blocks({3, 4, 3}, {4, 3, 5});
    const Solved hybrid(scene, mesh, "HYBRID");
    EXPECT_LT(hybrid.recovered_error().relative, 0.2);
    for (const char* name : {"3STEPD", "BLIND:SCHUR", "HYBRID:CHOLMOD"}) {
      const Solved other(scene, mesh, name);
      EXPECT_LT(testing::stress_error(hybrid.problem(), other.solution, hybrid.solution), 1e-7)
          << name;
    }
    // Both bounds of the strain energy.
    EXPECT_GE(hybrid.energy() * (1 + 1e-9), Solved(scene, mesh, "P3").energy());
  }
}

// A constant stress passes any of the laws: σ_yy = −p, and with friction μ ≥ τ/p also shear.
TEST(BondedFaces, AConstantStressPassesThreeLawsOnALine) {
  Scene scene =
      on_floor({pair("left", Law::bonded), pair("middle", {}, 0.5), pair("right", {}, 2)});
  scene.boundary["displacement:floor"].support = BoundaryValues::Support::normal;
  scene.boundary["force:top"].traction_MPa = {{{Vector2d(0, -20), Vector2d(0, -20)}}};
  scene.point_supports = {{.at_mm = {0, -6}, .displacement_mm = {0., std::nullopt}}};
  for (const std::array<int, 3>& upper : {std::array{2, 3, 2}, {3, 4, 5}, {1, 7, 2}})
    for (const char* name : {"HYBRID", "HYBRID:k=2", "P2", "P3", "3STEPD", "BLIND:SCHUR"}) {
      const Solved solved(scene, blocks({2, 3, 2}, upper), name);
      double off = 0;
      for (std::size_t t = 0; t < solved.solution.stress.size(); ++t) {
        const Eigen::Matrix3Xd stress = solved.solution.stress[t];
        off = std::max(off, (stress.colwise() - Eigen::Vector3d(0, -20, 0)).cwiseAbs().maxCoeff());
      }
      EXPECT_LT(off, 2e-6) << name << " " << upper[0];
    }
}

// The middle is a crack between bonded parts: it opens under tension, and is a hole for Airy's
// function. At its ends, where a vertex is one of both faces, nothing jumps.
TEST(BondedFaces, ACrackBetweenThemOpensAndSlips) {
  for (const double pull_MPa : {15., -15.})
    for (const std::array<int, 3>& upper : {std::array{3, 6, 3}, {4, 5, 2}}) {
      Scene scene = on_floor(
          {pair("left", Law::bonded), pair("middle", {}, 0.3), pair("right", Law::bonded)});
      scene.boundary["force:top"].traction_MPa = {
          {{Vector2d(10, pull_MPa), Vector2d(10, pull_MPa)}}};
      const Mesh mesh = blocks({3, 6, 3}, upper);
      const Solved hybrid(scene, mesh, "HYBRID:k=2");
      const double energy = hybrid.energy();
      EXPECT_NO_THROW(validate(hybrid.problem().mesh));
      EXPECT_EQ(hole_count(hybrid.problem().mesh), 1);
      if (pull_MPa > 0) {
        EXPECT_LT(hybrid.solution.F_C.norm(), 1e-6);
      } else {
        EXPECT_GT(hybrid.solution.F_C.norm(), 1);
      }
      const ConstitutiveError error = hybrid.recovered_error();
      EXPECT_TRUE(error.flaw.empty()) << error.flaw;
      EXPECT_LT(error.relative, 0.15);
      for (const char* name : {"P2", "P3"}) {
        const Solved other(scene, mesh, name);
        EXPECT_NEAR(other.energy(), energy, 0.03 * energy) << name;
      }
    }
}

// Blocks side by side on a base: one of its vertices has two partners, which face each other.
TEST(BondedFaces, ThreeBodiesMeetInAPoint) {
  Mesh mesh;
  mesh.name = "joint";
  testing::add_block(mesh, "left base", {0, -6}, {6, 0}, 5, 4,
                     {"displacement:floor", "contact:seam of left", "contact:left base", "force"});
  testing::add_block(
      mesh, "right base", {6, -6}, {12, 0}, 4, 4,
      {"displacement:floor", "force", "contact:right base", "contact:seam of right"});
  testing::add_block(mesh, "left", {0, 0}, {6, 5}, 4, 4,
                     {"contact:left", "contact:left side", "force:top", "force"});
  testing::add_block(mesh, "right", {6, 0}, {12, 5}, 5, 3,
                     {"contact:right", "force:push", "force:top", "contact:right side"});
  validate(mesh);
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0, 0};
  scene.boundary["force:top"].pressure_MPa = {{{20., 40.}, {Vector2d(0, 5), Vector2d(12, 5)}}};
  scene.boundary["force:push"].pressure_MPa = {{{10., 10.}}};
  const auto between = [](const char* one, const char* other) {
    return ContactPair{.between = {{{one}, {other}}}, .friction = 0.4};
  };
  scene.contacts = {
      between("contact:left", "contact:left base"),
      between("contact:right", "contact:right base"),
      between("contact:left side", "contact:right side"),
      {.between = {{{"contact:seam of left"}, {"contact:seam of right"}}}, .law = Law::bonded}};
  double before = 1;
  for (const char* name : {"HYBRID", "HYBRID:k=2", "HYBRID:k=3"}) {
    const Solved solved(scene, mesh, name);
    const ConstitutiveError error = solved.recovered_error();
    EXPECT_TRUE(error.flaw.empty()) << error.flaw;
    EXPECT_LT(error.relative, 0.9 * before) << name;
    before = error.relative;
  }
  EXPECT_NE(why_no_control_points(pose(scene, mesh)).find("two partners, at (6, 0)"),
            std::string::npos);
}

TEST(BondedFaces, AreRefusedWhereTheyAreApart) {
  Mesh mesh = blocks({2, 3, 2}, {2, 3, 2});
  std::vector<bool> of_block(mesh.vertices.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) of_block[v] = mesh.triangle_body[t] == 1;
  for (std::size_t v = 0; v < of_block.size(); ++v)
    if (of_block[v]) mesh.vertices[v].y() += 0.5;
  const std::string complaint =
      testing::complaint_of<SceneError>([&] { pose(on_floor(all_bonded), mesh); });
  EXPECT_NE(complaint.find("0.5 mm apart"), std::string::npos) << complaint;
}

}  // namespace
}  // namespace airybench::bonded_faces_test
