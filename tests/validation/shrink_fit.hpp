// A quarter of two rings between rollers, the inner one too large by δ, in plane strain: Lamé's
// pressure.
#pragma once

#include <numbers>
#include <vector>

#include "assembly/problem/scene.hpp"
#include "tests/support/pieces.hpp"

namespace airybench::testing {

struct ShrinkFit {
  static constexpr double a = 10, b = 20, c = 30, delta = 0.01;  // mm; b: where they touch
  static constexpr double E_hub = 210000, E_rim = 70000, nu = 0.3;

  static double pressure_MPa() {
    const auto modulus = [](double E) { return E / (1 - nu * nu); };
    constexpr double ratio = nu / (1 - nu);
    const double softness = b / modulus(E_hub) * ((b * b + a * a) / (b * b - a * a) - ratio) +
                            b / modulus(E_rim) * ((c * c + b * b) / (c * c - b * b) + ratio);
    return delta / softness;
  }
  static Scene scene() {
    Scene scene;
    scene.crown_radius_mm.reset();
    scene.displacement_mm = {0, 0};
    scene.materials = {{"hub", {E_hub, nu}}, {"rim", {E_rim, nu}}};
    scene.contacts = {
        {.between = {{{"contact:hub"}, {"contact:rim"}}}, .friction = 0, .clearance_mm = -delta}};
    for (const char* side : {"displacement:x", "displacement:y"})
      scene.boundary[side].support = BoundaryValues::Support::normal;
    for (const char* face : {"contact:hub", "contact:rim"})
      scene.boundary[face].contact.face = CircularWall{{0, 0}, b, CircularWall::Bodies::inside};
    return scene;
  }
  // Radii from a to b and from b to c, each with as many edges around.
  static Mesh mesh(const std::vector<double>& hub, int hub_edges, const std::vector<double>& rim,
                   int rim_edges) {
    const SectorEnds quarter = {{0, std::numbers::pi / 2}, {"displacement:x", "displacement:y"}};
    Mesh mesh;
    mesh.name = "rings";
    add_ring_sector(mesh, "hub", hub, hub_edges, "force", "contact:hub", quarter);
    add_ring_sector(mesh, "rim", rim, rim_edges, "contact:rim", "force", quarter);
    return mesh;
  }
};

}  // namespace airybench::testing
