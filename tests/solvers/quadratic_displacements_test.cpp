// P2 is another discrete problem than all the others: exactness where the exact field is quadratic,
// admissibility, and its own contact law.
#include "solvers/displacement/quadratic_displacements.hpp"

#include <gtest/gtest.h>

#include "assembly/edge_forces.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::quadratic_displacements_test {
namespace {

using testing::displacement_deviation, testing::posed, testing::small_tooth;
constexpr double young = 2000, poisson = 0.3;

Solution solve(const std::shared_ptr<const Problem>& problem, const RunControl& control = {}) {
  return testing::solved_by("P2", assemble(problem, Blocks::contact_points), control);
}

TEST(QuadraticDisplacements, ReproducesQuadraticFieldsExactlyWithBodyForceAndTractions) {
  const Mesh mesh =
      testing::with_role(small_tooth(5, 4), BoundaryRole::contact, BoundaryRole::force);
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(displacement_deviation(*problem, solution.displacement, exact), 1e-11) << exact.name;
    EXPECT_EQ(solution.F_C.size(), 0);
    EXPECT_FALSE(solution.contact_iterations);  // no contact loop
    EXPECT_FALSE(solution.times[Stage::contact]);
  }
}

TEST(QuadraticDisplacements, NowherePenetratesTheWallAndMeetsWhatIsPrescribed) {
  for (const double mu : {0.0, 0.2, 1.0})
    for (const Eigen::Vector2d& body_force : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, -10)}) {
      Scene scene;
      scene.friction = mu;
      scene.body_force_N_per_mm3 = body_force;
      const auto problem = posed(scene);
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::ok) << solution.message;
      const DisplacementField field = with_rigid_motion(*problem, solution.displacement);
      double closest = -1;
      for (int row = 0; row < static_cast<int>(problem->mesh.boundary.size()); ++row) {
        const BoundaryEdge& edge = problem->mesh.boundary[row];
        if (edge.role == BoundaryRole::force) continue;
        const auto &a = problem->mesh.vertices[edge.vertices[0]],
                   &b = problem->mesh.vertices[edge.vertices[1]];
        const auto [start, middle, end] = boundary_nodes(*problem, row);
        for (int i = 0; i <= 100; ++i) {
          const double s = i / 100.;
          const Eigen::Vector2d x = (1 - s) * a + s * b;
          const Eigen::Vector2d u = (1 - s) * (1 - s) * field.col(start) +
                                    2 * s * (1 - s) * field.col(middle) + s * s * field.col(end);
          if (edge.role == BoundaryRole::displacement) {
            EXPECT_LT((u - scene.displacement_mm).norm(), 1e-15);
          } else {
            const double r = edge_frame(a, b).normal.dot(u) - problem->loads.gap_mm(x, row);
            EXPECT_LE(r, 1e-13) << "at y = " << x.y();
            closest = std::max(closest, r);
          }
        }
      }
      EXPECT_GT(closest, -1e-12);  // it does touch
    }
}

TEST(QuadraticDisplacements, ContactForcesBalanceReactionsAndLoads) {
  Scene scene;
  scene.body_force_N_per_mm3 = {3, -1};
  const auto problem = posed(scene);
  const QuadraticDisplacements system = assemble_quadratic_displacements(*problem);
  const Solution solution = solve(problem);
  // Reactions from the definition: Σ over all nodes of the elements' forces is zero.
  Eigen::Vector2d reactions = Eigen::Vector2d::Zero(), contact = Eigen::Vector2d::Zero();
  for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t) {
    const QuadraticStiffness K =
        quadratic_stiffness(quadratic_strain(problem->vertices_of(t)), problem->area_mm2(t),
                            elasticity_of(problem->compliance_of(t)));
    const std::array<int, 6> nodes = triangle_nodes(*problem, t);
    Eigen::Matrix<double, 2, 6> local;
    for (int m = 0; m < 6; ++m) local.col(m) = solution.displacement.col(nodes[m]);
    const Eigen::Matrix<double, 12, 1> force = K * local.reshaped();
    for (int m = 0; m < 6; ++m)
      if (system.given.at[nodes[m]]) reactions += force.segment<2>(2 * m);
  }
  const Eigen::Matrix2Xd loads = nodal_loads(*problem);
  for (Eigen::Index node = 0; node < loads.cols(); ++node)
    if (system.given.at[node]) reactions -= loads.col(node);
  for (int p = 0; p < system.control.law.count; ++p)  // n = x, s = y on the tip
    contact += solution.F_C.segment<2>(2 * p);
  const Eigen::Vector2d weight = 80 * scene.body_force_N_per_mm3;
  EXPECT_LT((reactions + contact + weight).norm(), 1e-9 * reactions.norm());
}

TEST(QuadraticDisplacements, AContactVertexOnThePrescribedBoundaryHasNoLaw) {
  const Mesh mesh =
      testing::with_role(small_tooth(6, 5), BoundaryRole::force, BoundaryRole::displacement);
  Scene scene;
  scene.displacement_mm = {0.005, 0.002};  // less than the gap at the face's ends
  const auto problem = posed(scene, mesh);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_EQ(solution.F_C.size(), 2 * 9);  // 11 nodes on the face, less its ends
  const DisplacementField u = with_rigid_motion(*problem, solution.displacement);
  for (const BoundaryEdge& edge : mesh.boundary) {
    if (edge.role != BoundaryRole::displacement) continue;
    for (const int vertex : edge.vertices)
      EXPECT_LT((u.col(vertex) - scene.displacement_mm).norm(), 1e-16);
  }
}

TEST(QuadraticDisplacements, ABodyThatOnlyMovesHasNoStress) {
  Scene scene;
  scene.clearance_mm = 1;
  const auto problem = posed(scene);
  const Solution solution = solve(problem);
  EXPECT_TRUE(solution.F_C.isZero(0));
  EXPECT_LT(std::sqrt(stress_norm_squared(*problem, solution.stress)), 1e-9);
  testing::ExactField moved;
  moved.displacement = [&](const auto&) { return scene.displacement_mm; };
  EXPECT_LT(displacement_deviation(*problem, solution.displacement, moved), 1e-12);
}

TEST(QuadraticDisplacements, ABodyFarFromTheOriginHasTheSameAnswer) {
  Mesh moved = small_tooth(6, 5);
  for (Eigen::Vector2d& x : moved.vertices) x += Eigen::Vector2d(1e5, -2e5);
  Scene scene;
  scene.crown_radius_mm.reset();
  const Solution here = solve(posed(scene)), there = solve(posed(scene, moved));
  ASSERT_EQ(there.status, Status::ok) << there.message;
  EXPECT_LT((here.F_C - there.F_C).norm(), 1e-8 * here.F_C.norm());
}

TEST(QuadraticDisplacements, WhatGoesWrongBecomesAStatus) {
  EXPECT_EQ(solve(posed({}), testing::out_of_time()).status, Status::timeout);

  const auto problem = posed({});
  const DualSystem system = assemble(problem, Blocks::contact_points);
  const auto spoiled = [&](auto spoil) {
    return run(
        [&](const DualSystem& s, const RunControl& control) {
          Solution solution = testing::solved_by("P2", s, control);
          spoil(solution);
          return solution;
        },
        system, {});
  };
  EXPECT_EQ(spoiled([](Solution&) {}).status, Status::ok);
  EXPECT_EQ(spoiled([](Solution& s) { s.F_C.conservativeResize(5); }).status, Status::breakdown);
  EXPECT_EQ(spoiled([](Solution& s) { s.displacement.conservativeResize(2, 3); }).status,
            Status::breakdown);
  EXPECT_EQ(spoiled([](Solution& s) { s.displacement(1, 4) = std::nan(""); }).status,
            Status::breakdown);
}

}  // namespace
}  // namespace airybench::quadratic_displacements_test
