// Bodies in contact with each other, against closed forms. Sources: docs/validation.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/plan/scene_file.hpp"
#include "bench/verify/verifier.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/places.hpp"
#include "tests/support/solved_scene.hpp"
#include "tests/validation/committed_profiles.hpp"
#include "tests/validation/edge_tractions.hpp"
#include "tests/validation/shrink_fit.hpp"

namespace airybench::two_bodies_closed_forms_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using testing::add_ring_sector;
using testing::edge_tractions;
using testing::EdgeTraction;
using testing::expect_committed;
using testing::fitted;
using testing::ShrinkFit;

using Solved = testing::SolvedScene;

std::vector<EdgeTraction> edge_tractions_of(const Solved& solved) {
  return edge_tractions(solved.problem(), solved.system.contact, solved.solution.F_C);
}

void hold(Scene& scene, const std::string& label, const Vector2d& at_mm) {
  scene.boundary[label].displacement_mm = LinearValue<Vector2d>{{at_mm, at_mm}};
}

CircularWall circle(const Vector2d& centre_mm, double radius_mm) {
  return {centre_mm, radius_mm, CircularWall::Bodies::inside};
}

// From one to the other, each 1 + `growth` times the last at most.
std::vector<double> geometric(double from, double to, double growth) {
  const int n = static_cast<int>(std::ceil(std::log(to / from) / std::log1p(growth)));
  std::vector<double> radii;
  for (int i = 0; i <= n; ++i) radii.push_back(from * std::pow(to / from, double(i) / n));
  return radii;
}

TEST(ClosedForms, AShrinkFitHasLamesPressure) {
  constexpr double a = ShrinkFit::a, b = ShrinkFit::b, c = ShrinkFit::c;
  const Scene scene = ShrinkFit::scene();
  const Mesh mesh = ShrinkFit::mesh(geometric(a, b, 0.1), 16, geometric(b, c, 0.06), 21);
  for (const auto& [name, accuracy] :
       {std::pair("HYBRID", 0.01), {"HYBRID:k=2", 3e-3}, {"P2", 3e-3}, {"P3", 3e-3}}) {
    const Solved solved(scene, mesh, name);
    const double resultant = *verify(solved.system, solved.solution, nullptr).normal_resultant_N;
    EXPECT_NEAR(-resultant / (pi / 2 * b) / ShrinkFit::pressure_MPa(), 1, accuracy) << name;
  }
}

// docs/bodies: a mesh of cylinders.geo. Without friction Hertz' pressure, whatever the materials.
TEST(ClosedForms, TwoCylindersOfTwoMaterialsAreHertzs) {
  Scene scene = read_scene(testing::source_folder() / "docs/bodies/cylinders.json");
  const Mesh mesh = read_msh(testing::test_data("validation/cylinders.msh"));
  constexpr double R = 1 / (1. / 8 + 1. / 12),
                   softness = (1 - 0.3 * 0.3) * (1. / 210000 + 1. / 70000);
  for (const auto& [name, refined] : {std::pair("HYBRID:k=2", 0), {"HYBRID", 1}}) {
    scene.mesh.refine = refined;
    const Solved solved(scene, mesh, name);
    const std::vector<EdgeTraction> edges = edge_tractions_of(solved);
    double P = 0;
    for (const EdgeTraction& edge : edges) P += edge.pressure * edge.length();
    const double a = std::sqrt(4 * P * R * softness / pi), p0 = 2 * P / (pi * a);
    double off = 0, half_width = 0;
    for (const EdgeTraction& edge : edges) {
      const double x = edge.middle().x();
      if (std::abs(x) < 0.9 * a)
        off = std::max(off, std::abs(edge.pressure / p0 - std::sqrt(1 - x * x / (a * a))));
      if (edge.pressure > 0)
        half_width = std::max({half_width, std::abs(edge.start.x()), std::abs(edge.end.x())});
    }
    EXPECT_LT(off, 0.02) << name;
    EXPECT_NEAR(half_width / a, 1, 0.15) << name;
    EXPECT_FALSE(solved.problem().opposite.empty());
  }
}

// Two equal cylinders, of any ν: pressed by P and sheared by Q as Cattaneo and Mindlin say.
TEST(ClosedForms, TwoEqualCylindersAreCattaneosAndMindlins) {
  constexpr double mu = 0.2, radius = 8, modulus = 200 / (1 - 0.3 * 0.3) / 2;
  const Mesh half_plane = read_msh(testing::test_data("validation/half_plane.msh"));
  Mesh mesh;
  mesh.name = "half planes";
  // The other one is mirrored, larger by 1.3 %, and moved, so that no vertices meet.
  const auto add = [&](const std::string& body, double stretch, double moved_mm) {
    const int first = static_cast<int>(mesh.vertices.size());
    const bool mirrored = stretch < 0;
    for (const Vector2d& v : half_plane.vertices)
      mesh.vertices.emplace_back(std::abs(stretch) * v.x() + moved_mm, stretch * v.y());
    for (auto t : half_plane.triangles) {
      if (mirrored) std::swap(t[1], t[2]);
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    for (const BoundaryEdge& edge : half_plane.boundary) {
      auto [a, b] = edge.vertices;
      if (mirrored) std::swap(a, b);
      const std::string role = boundary_label(half_plane, edge);
      testing::add_edge(mesh, first + a, first + b, role == "force" ? role : role + ":" + body);
    }
    testing::name_body(mesh, body);
  };
  add("upper", 1, 0);
  add("lower", -1.013, 0.003);
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.material = {200, 0.3};
  scene.contacts = {{.between = {{{"contact:upper"}, {"contact:lower"}}}, .friction = mu}};
  scene.boundary["contact:upper"].contact.face = circle({0, radius}, radius);
  scene.boundary["contact:lower"].contact.face = circle({0, -radius}, radius);
  hold(scene, "displacement:upper", {0.06, -0.5});
  hold(scene, "displacement:lower", {0, 0});
  for (const auto& [name, refined] : {std::pair("HYBRID", 1), {"HYBRID:k=2", 0}}) {
    scene.mesh.refine = refined;
    const Solved solved(scene, mesh, name);
    const std::vector<EdgeTraction> edges = edge_tractions_of(solved);
    double P = 0, Q = 0;
    for (const EdgeTraction& edge : edges) {
      P += edge.pressure * edge.length();
      Q += edge.shear * edge.length();
    }
    const double a = std::sqrt(4 * P * radius / 2 / (pi * modulus)), p0 = 2 * P / (pi * a),
                 c = a * std::sqrt(1 - Q / (mu * P));
    const auto normal = fitted(edges, 0.2, &EdgeTraction::pressure);
    const auto stick = fitted(edges, 0.3, [](auto& e) { return mu * e.pressure - e.shear; });
    EXPECT_NEAR(normal.half_width / a, 1, 0.005) << name;
    EXPECT_NEAR(normal.height / p0, 1, 0.005) << name;
    EXPECT_NEAR(stick.half_width / c, 1, 0.005) << name;
    EXPECT_LT(c, 0.8 * a);
    if (refined == 0) continue;
    expect_committed("two_cylinders", refined,
                     {{"P", P},
                      {"Q", Q},
                      {"a", normal.half_width},
                      {"p0", normal.height},
                      {"c", stick.half_width}});
    expect_committed("two_cylinders", refined, edges);
  }
}

// Half of a pin, held at its core, in a large plate: their axis is x = 0.
constexpr double hole_mm = 10;
Mesh pin_in_plate(double clearance_mm, int refined) {
  Mesh mesh;
  mesh.name = "pin";
  const testing::SectorEnds half = {{-pi / 2, pi / 2}, {"displacement:axis", "displacement:axis"}};
  add_ring_sector(mesh, "pin", geometric(0.02 * hole_mm, hole_mm - clearance_mm, 0.1 / refined),
                  61 * refined, "displacement:core", "contact:pin", half);
  add_ring_sector(mesh, "plate", geometric(hole_mm, 40 * hole_mm, 0.1 / refined), 57 * refined,
                  "contact:hole", "displacement:far", half);
  return mesh;
}
Scene pressed_pin(double clearance_mm, double down_mm) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.material = {210000, 0.3};
  scene.contacts = {{.between = {{{"contact:pin"}, {"contact:hole"}}}, .friction = 0}};
  scene.boundary["contact:pin"].contact.face = circle({0, 0}, hole_mm - clearance_mm);
  scene.boundary["contact:hole"].contact.face = circle({0, 0}, hole_mm);
  hold(scene, "displacement:axis", {0, 0});
  scene.boundary["displacement:axis"].support = BoundaryValues::Support::normal;
  hold(scene, "displacement:core", {0, -down_mm});
  hold(scene, "displacement:far", {0, 0});
  return scene;
}

// A pin of radius R, smaller than its hole by ΔR and of its material, pressed into it by P without
// friction touches it for |φ| < ε. Persson (1964), as Ciavarella and Decuzzi (2001) write it:
//
//   E* ΔR / P = (2 − ln(1 + b²) − 2b⁴) / (π b² (1 + b²)),   b = tan(ε/2),   E* = E/(1 − ν²)
//   p R / P   = 2 t / (π s (1 + y²)) + ln((s + t)/(s − t)) / (2π b² s²),
//   y = tan(φ/2),   s = √(1 + b²),   t = √(b² − y²)
double clearance_over_load(double b) {
  const double square = b * b;
  return (2 - std::log1p(square) - 2 * square * square) / (pi * square * (1 + square));
}
double perssons_pressure(double phi, double b) {
  const double y = std::tan(phi / 2), s = std::sqrt(1 + b * b), t = std::sqrt(b * b - y * y);
  return 2 * t / (pi * s * (1 + y * y)) + std::log((s + t) / (s - t)) / (2 * pi * b * b * s * s);
}
double perssons_b(double of_clearance_over_load) {
  double low = 1e-3, high = 1;
  for (int i = 0; i < 60; ++i)
    (clearance_over_load((low + high) / 2) > of_clearance_over_load ? low : high) =
        (low + high) / 2;
  return low;
}

TEST(ClosedForms, APinInAHoleThatItNearlyFillsIsPerssons) {
  for (const auto& [clearance_mm, down_mm, refined] :
       {std::tuple(0.02, 0.03, 1), {1e-3, 0.1, 1}, {0.02, 0.1, 1}, {0.02, 0.1, 2}}) {
    const Scene scene = pressed_pin(clearance_mm, down_mm);
    const Solved solved(scene, pin_in_plate(clearance_mm, refined), "HYBRID:k=2");
    const std::vector<EdgeTraction> edges = edge_tractions_of(solved);
    const auto angle = [](const Vector2d& v) { return std::atan2(v.x(), -v.y()); };
    double P = 0;  // of both halves
    for (const EdgeTraction& edge : edges)
      P += 2 * edge.pressure * edge.length() * std::cos(angle(edge.middle()));
    const double modulus = scene.material.young_MPa / (1 - 0.3 * 0.3),
                 clearance = modulus * clearance_mm / P, b = perssons_b(clearance),
                 reach = 2 * std::atan(b);
    double off = 0, touching = 0;
    for (const EdgeTraction& edge : edges) {
      const double phi = angle(edge.middle()), pressure = edge.pressure * hole_mm / P;
      if (phi < 0.95 * reach) off = std::max(off, std::abs(pressure - perssons_pressure(phi, b)));
      if (pressure > 0) touching = std::max({touching, angle(edge.start), angle(edge.end)});
      if (refined == 2)
        expect_committed("persson", refined, "pressure R / P", phi * 180 / pi, pressure, 1);
    }
    off /= perssons_pressure(0, b);
    EXPECT_LT(off, 0.02 / refined) << clearance_mm << " " << down_mm;
    EXPECT_NEAR(touching / reach, 1, 0.05);
    if (refined < 2) continue;
    expect_committed("persson", refined, "E* clearance / P", 0, clearance, 1);
    expect_committed("persson", refined, "worst deviation for phi < 0.95 reach", 0, off, 1);
  }
}

}  // namespace
}  // namespace airybench::two_bodies_closed_forms_test
