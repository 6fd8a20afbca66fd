// The default tooth and others by stresses of every degree: HYBRID's answer for k = 1, the
// reference values as k grows, equilibrium, the contact law, loads and supports.
#include "solvers/condensation/degree_system.hpp"

#include <gtest/gtest.h>

#include "assembly/elasticity.hpp"
#include "assembly/equilibrium_element.hpp"
#include "mesh/bisection.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/methods.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::degree_system_test {
namespace {

using testing::small_tooth;

DegreeAnswer solved(const Problem& problem, int degree) {
  const DegreeAnswer answer = solve_degree_system(problem, assemble_degree_system(problem, degree));
  EXPECT_TRUE(answer.contact_converged);
  EXPECT_LT(answer.unbalanced, 1e-10) << degree;
  if (answer.F_C.size() > 0) {
    EXPECT_LT(relative_natural_map(answer.condensed, answer.F_C), 1e-11) << degree;
  }
  return answer;
}

Eigen::Vector2d resultant(const DegreeAnswer& answer) {
  const int m = answer.condensed.points.components;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < answer.F_C.size(); ++i) sum(i % m) += answer.F_C(i);
  return sum;
}

Scene loaded_scene() {
  Scene scene;
  scene.body_force_N_per_mm3 = {0.4, -0.2};
  LinearValue<double> pressure{{20, 40}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 0)}};
  scene.boundary["force"].pressure_MPa = pressure;
  return scene;
}

TEST(DegreeSystem, OfDegreeOneIsHybrid) {
  Scene frictionless, rolling, inclined;
  inclined.crown_radius_mm.reset();
  inclined.wall = FlatWall{{10.004, 0}, {-1, 0.002}};
  frictionless.friction = 0;
  rolling.boundary["displacement"].support = BoundaryValues::Support::normal;
  const Mesh tooth = small_tooth(6, 5),
             guided = testing::with_role(tooth, BoundaryRole::force, BoundaryRole::displacement);
  for (const auto& [scene, mesh] : {std::pair(Scene{}, tooth),
                                    {frictionless, tooth},
                                    {loaded_scene(), tooth},
                                    {rolling, guided},
                                    {inclined, tooth}}) {
    const DualSystem system = assemble(testing::posed(scene, mesh), Blocks::contact_points);
    const Solution hybrid = run(select_methods("HYBRID").front(), system, {});
    ASSERT_EQ(hybrid.status, Status::ok) << hybrid.message;
    const DegreeAnswer answer = solved(*system.problem, 1);
    EXPECT_LT((answer.F_C - hybrid.F_C).norm(), 1e-9 * hybrid.F_C.norm());
    EXPECT_NEAR(answer.strain_energy_Nmm, stress_norm_squared(*system.problem, hybrid.stress) / 2,
                1e-8);
  }
}

// Linear stresses with tractions, displacements and body force; no contact.
TEST(DegreeSystem, LinearStressesAreExactForEveryDegree) {
  constexpr double young = 210000, poisson = 0.3;
  const Mesh mesh =
      testing::with_role(small_tooth(2, 2), BoundaryRole::contact, BoundaryRole::force);
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const Problem problem = make_problem(mesh, {compliance({young, poisson}, Plane::stress)},
                                         testing::loads_of(exact), 0);
    for (int k = 1; k <= highest_stress_degree; ++k) {
      const DegreeAnswer answer = solved(problem, k);
      double off = 0, size = 0;
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d expected = exact.stress(problem.vertices_of(t).col(i));
          const Eigen::Vector3d own = answer.stress[t].col(i * (k + 1) * (k + 2) / 2);
          off = std::max(off, (own - expected).cwiseAbs().maxCoeff());
          size = std::max(size, expected.cwiseAbs().maxCoeff());
        }
      EXPECT_LT(off, 1e-9 * size) << exact.name << ' ' << k;
    }
  }
}

// Smaller towards the corners, where the stress has singularities, and where points open or slip.
Mesh graded_tooth() {
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(0, -5), Eigen::Vector2d(0, 5),
                                                  Eigen::Vector2d(10, -3), Eigen::Vector2d(10, 3)};
  return bisected(small_tooth(2, 2),
                  [&](const TrianglePart& part) {
                    const auto& [a, b, c] = part.corners;
                    const Eigen::Vector2d centre = (a + b + c) / 3;
                    double allowed = 10 - centre.x() < 0.2 ? 0.1 : 2;
                    for (const Eigen::Vector2d& corner : corners)
                      allowed = std::min(allowed, std::max(0.01, 0.7 * (centre - corner).norm()));
                    return std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()}) > allowed;
                  })
      .mesh;
}

// The reference values are those of stresses of degree 7 on a graded mesh.
TEST(DegreeSystem, TendsToTheReferenceValuesOfTheTooth) {
  struct Expected {
    double friction;
    Eigen::Vector2d resultant_N;
    double energy_Nmm;
  };
  const Expected cases[] = {{0.2, {-2910.0265, -196.4404}, 27.2027517},
                            {0, {-2905.9981, 0}, 26.5292017}};
  for (const Expected& expected : cases) {
    Scene scene;
    scene.friction = expected.friction;
    const auto problem = testing::posed(scene, graded_tooth());
    constexpr int highest = testing::sanitized ? 2 : highest_stress_degree;
    for (int k = 1; k <= highest; ++k) {
      const DegreeAnswer answer = solved(*problem, k);
      EXPECT_LT((resultant(answer) - expected.resultant_N).norm(), k == 1 ? 0.3 : 0.03) << k;
      EXPECT_NEAR(answer.strain_energy_Nmm, expected.energy_Nmm, k == 1 ? 6e-3 : 1e-4) << k;
    }
  }
}

TEST(DegreeSystem, RefusesWhatItHasNot) {
  const auto complaint = [](const Problem& problem, int degree) -> std::string {
    try {
      assemble_degree_system(problem, degree);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  Scene steps;
  steps.equal_steps = 3;
  EXPECT_EQ(complaint(*testing::posed(steps), 2),
            "stresses of degree 2: load steps (allowed: one step)");
  Scene socket;
  socket.crown_radius_mm.reset();
  socket.wall = CircularWall{{-390, 0}, 400.01, CircularWall::Bodies::inside};
  EXPECT_EQ(complaint(*testing::posed(socket), 3),
            "stresses of degree 3: a wall whose normal turns along an edge (allowed: flat walls)");
  EXPECT_EQ(complaint(*testing::posed({}), 5), "stresses of degree 5 (allowed: 1 to 4)");
  EXPECT_EQ(complaint(*testing::posed({}), 0), "stresses of degree 0 (allowed: 1 to 4)");
}

}  // namespace
}  // namespace airybench::degree_system_test
