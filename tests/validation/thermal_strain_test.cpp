// Bodies that are warmed: free, held, joined, pressed on each other.
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/total_displacement.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/support/solved_scene.hpp"
#include "tests/support/two_blocks.hpp"
#include "tests/validation/shrink_fit.hpp"
#include "verify/verifier.hpp"

namespace airybench::thermal_strain_test {
namespace {

using Eigen::Vector2d;
using Solved = testing::SolvedScene;
using testing::ShrinkFit;
constexpr double alpha = 12e-6;  // 1/K
const char* const all_methods[] = {"HYBRID",      "HYBRID:k=2", "HYBRID:k=3",   "HYBRID:CG",
                                   "HYBRID:PDAS", "P2",         "P3",           "3STEPD",
                                   "BLIND:SCHUR", "SDTIC3",     "HYBRID:MUMPS", "3STEPD:REFINED"};

LinearValue<double> uniform(double temperature_K) { return {{temperature_K, temperature_K}}; }

Mesh block(const testing::Sides& sides) {
  Mesh mesh;
  mesh.name = "block";
  testing::add_block(mesh, "block", {0, 0}, {10, 4}, 7, 3, sides);
  validate(mesh);
  return mesh;
}

Scene warm_block(const LinearValue<double>& temperature_K, Plane plane) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.displacement_mm = {0, 0};
  scene.plane = plane;
  scene.material = {200000, 0.3, alpha};
  scene.temperature_K["block"] = temperature_K;
  return scene;
}

double largest_off(const Solved& solved, const Eigen::Vector3d& stress) {
  double off = 0;
  for (std::size_t t = 0; t < solved.solution.stress.size(); ++t) {
    const Eigen::Matrix3Xd own = solved.solution.stress[t];
    off = std::max(off, (own.colwise() - stress).cwiseAbs().maxCoeff());
  }
  return off;
}

// A temperature that is linear in x and y bends a free body and makes no stress. It would be some
// 240 MPa if it were held.
TEST(ThermalStrain, MakesNoStressWhereNothingHolds) {
  const Mesh mesh = block({"force", "force", "force", "force"});
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    Scene scene = warm_block({{20, 100}, {Vector2d(0, 0), Vector2d(6, 4)}}, plane);
    scene.point_supports = {{.at_mm = {0, 0}, .displacement_mm = {0., 0.}},
                            {.at_mm = {10, 0}, .displacement_mm = {std::nullopt, 0.}}};
    for (const char* name : {"HYBRID", "HYBRID:k=2", "P2", "P3", "3STEPD", "BLIND:SCHUR"})
      EXPECT_LT(largest_off(Solved(scene, mesh, name), {0, 0, 0}), 1e-7) << name;
  }
}

// Between rollers: ε = 0, σ = −A ε0.
TEST(ThermalStrain, PressesABlockBetweenRollers) {
  const Mesh mesh = block(
      {"displacement:below", "displacement:right", "displacement:above", "displacement:left"});
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    Scene scene = warm_block(uniform(50), plane);
    for (const char* side : {"below", "right", "above", "left"})
      scene.boundary[std::string("displacement:") + side].support = BoundaryValues::Support::normal;
    const double expected = -200000 * alpha * 50 / (plane == Plane::strain ? 1 - 2 * 0.3 : 1 - 0.3);
    for (const char* name : all_methods) {
      const Solved solved(scene, mesh, name);
      EXPECT_LT(largest_off(solved, {expected, expected, 0}), 1e-6 * -expected) << name;
    }
  }
}

// A fit whose faces are bonded, not just pressed: an interference is a temperature. Its energy is
// that of Lamé's pressure on the way δ.
TEST(ThermalStrain, IsTheInterferenceOfBondedRings) {
  const auto radii = [](double from, double to) {
    return std::vector<double>{from, std::lerp(from, to, 0.5), to};
  };
  const Mesh mesh =
      ShrinkFit::mesh(radii(ShrinkFit::a, ShrinkFit::b), 24, radii(ShrinkFit::b, ShrinkFit::c), 31);
  Scene scene = ShrinkFit::scene();
  scene.contacts[0] = {.between = scene.contacts[0].between, .law = ContactPair::Law::bonded};
  scene.boundary.erase("contact:hub");
  scene.boundary.erase("contact:rim");
  scene.materials["hub"].expansion_per_K = alpha;
  scene.temperature_K["hub"] =
      uniform(ShrinkFit::delta / (ShrinkFit::b * alpha * (1 + ShrinkFit::nu)));
  const double energy =
      ShrinkFit::pressure_MPa() * ShrinkFit::delta / 2 * ShrinkFit::b * std::numbers::pi / 2;
  for (const char* name : {"HYBRID:k=2", "HYBRID:k=3", "P2", "P3"})
    EXPECT_NEAR(Solved(scene, mesh, name).energy(), energy, 0.01 * energy) << name;
}

// Friction, bodies of two materials, one of them warmer to one side, meshes that do not match.
TEST(ThermalStrain, AllMethodsAgreeAndTheErrorIsKnown) {
  const Mesh mesh = testing::two_blocks(7, 10);
  for (const double friction : {0., 0.3}) {
    Scene scene = testing::pressed(friction);
    scene.materials["base"].expansion_per_K = 23e-6;
    scene.materials["block"].expansion_per_K = alpha;
    scene.temperature_K = {{"base", {{-20, 60}, {Vector2d(0, 0), Vector2d(12, 3)}}},
                           {"block", uniform(40)}};
    const Solved hybrid(scene, mesh, "HYBRID");
    const Reference reference = compute_reference(hybrid.system);
    for (const auto& [names, allowed] : {std::pair("HYBRID,HYBRID:CHOLMOD", 1e-9),
                                         {"3STEPD:REFINED,BLIND:SCHUR:REFINED", 1e-9},
                                         {"3STEPD,BLIND:SCHUR,SDTIC3", 1e-6}})
      for (const Method& method : select_methods(names)) {
        const Solved other(scene, mesh, method.name);
        const WorstMeasure worst = worst_measure(verify(other.system, other.solution, &reference));
        EXPECT_LT(worst.value, allowed) << method.name << " mu " << friction << worst.name;
      }
    double before = 1;
    for (const int degree : {1, 2, 3, 4}) {
      const Solved solved(scene, mesh, hybrid_of_degree(degree));
      const ConstitutiveError error = solved.recovered_error();
      EXPECT_TRUE(error.flaw.empty()) << error.flaw;
      EXPECT_EQ(error.guaranteed, friction == 0) << degree;
      EXPECT_LT(error.relative, before) << degree;
      before = error.relative;
    }
    EXPECT_LT(before, 0.05);
    for (const char* name : {"P2", "P3", "P4"}) {
      const Solved own(scene, mesh, name);
      EXPECT_LT(worst_measure(verify_displacement(own.system, own.solution)).value, 1e-11) << name;
    }
  }
}

TEST(ThermalStrain, WithoutAnExpansionOrABodyIsRefused) {
  const Mesh mesh = block({"displacement", "force", "force", "force"});
  Scene scene = warm_block(uniform(50), Plane::strain);
  scene.material.expansion_per_K.reset();
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }),
                        {"temperature_K: block", "no expansion_per_K"});
  scene = warm_block(uniform(50), Plane::strain);
  scene.temperature_K["blcok"] = uniform(1);
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }),
                        {"temperature_K: blcok", "perhaps block"});
  scene.temperature_K = {{"block", uniform(1e7)}};
  testing::expect_named(testing::complaint_of<SceneError>([&] { pose(scene, mesh); }),
                        {"temperature_K: block", "1e+07", "-1e6 to 1e6 K"});
}

}  // namespace
}  // namespace airybench::thermal_strain_test
