// Kinds of methods on small systems: exact fields, scenes, and injected failures. All methods are
// in product_test.cpp; constant stress at a wall is in tests/validation.
#include <gtest/gtest.h>

#include "assembly/elements/edge_forces.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/far_from_origin.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/solved.hpp"

namespace airybench::methods_test {
namespace {

using testing::posed, testing::scenes_named, testing::small_tooth, testing::stress_deviation,
    testing::with_role;

class EveryKindOfMethod : public ::testing::TestWithParam<Method> {
 protected:
  // Iterative methods as far as rounding lets them go.
  Solution solve(std::shared_ptr<const Problem> problem,
                 const RunControl& control = testing::with_tolerance(1e-13)) {
    system_ = assemble(GetParam(), std::move(problem));
    return run(GetParam(), *system_, control);
  }
  // The answer of a method of another kind.
  static Solution other_answer(const std::shared_ptr<const Problem>& problem) {
    return testing::solved_by(GetParam().name == "HYBRID" ? "3STEPD" : "HYBRID",
                              airy_system(problem));
  }
  std::unique_ptr<ContactSystem> system_;
};
INSTANTIATE_TEST_SUITE_P(Table, EveryKindOfMethod, ::testing::ValuesIn(testing::kinds_of_methods()),
                         testing::readable);

// Without contact; then without any constraint at all, all of the boundary being held.
TEST_P(EveryKindOfMethod, ReproducesLinearStressesExactlyWithoutContact) {
  constexpr double young = 2000, poisson = 0.3;
  for (const bool all_held : {false, true}) {
    using enum BoundaryRole;
    Mesh mesh = with_role(small_tooth(5, 4), contact, force);
    if (all_held) mesh = with_role(mesh, force, displacement);
    for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
      SCOPED_TRACE(exact.name + (all_held ? ", all held" : ""));
      const auto problem = std::make_shared<const Problem>(make_problem(
          mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::ok) << solution.message;
      EXPECT_LT(stress_deviation(*problem, solution.stress, exact), 1e-10);
      EXPECT_FALSE(solution.contact_iterations);
      EXPECT_FALSE(solution.times[Stage::contact]);
      if (const auto* airy = dynamic_cast<const AirySystem*>(system_.get()); airy && all_held) {
        EXPECT_EQ(airy->n_f() + airy->n_c(), 0);
      }
    }
  }
}

TEST_P(EveryKindOfMethod, AgreesWithAnotherKindOfMethodOnEveryScene) {
  int turn = 0;
  for (const auto& [name, scene] : testing::scene_variants()) {
    if (testing::left_out(turn++)) continue;
    const auto problem = posed(scene);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    const Solution other = other_answer(problem);
    EXPECT_LE(testing::distance(solution.F_C, other.F_C), 1e-9 * other.F_C.norm()) << name;
    // The norm is about 7 where the body is stressed, and 0 where it is only moved.
    EXPECT_LE(stress_distance(*problem, solution.stress, other.stress), 1e-9) << name;
  }
}

TEST_P(EveryKindOfMethod, ScenesWithNoForceHaveNoStress) {
  for (const auto& [name, scene] : scenes_named({"no load", "nothing touches", "pulled away"})) {
    const auto problem = posed(scene);
    const Solution solution = solve(problem);
    EXPECT_TRUE(solution.F_C.isZero(0)) << name;
    EXPECT_LT(std::sqrt(stress_norm_squared(*problem, solution.stress)), 1e-9) << name;
  }
}

TEST_P(EveryKindOfMethod, StressIsStrictlyAdmissibleOnWholeContactEdges) {
  const auto problem = posed({});
  const Solution solution = solve(problem);
  const double largest = solution.F_C.cwiseAbs().maxCoeff();
  testing::visit_boundary(*problem, [&](int row, int t, int k) {
    if (problem->mesh.boundary[row].role != BoundaryRole::contact) return;
    const TriangleVertices v = problem->vertices_of(t);
    const EdgeFrame frame = edge_frame(v.col(k), v.col((k + 1) % 3));
    for (int i = 0; i <= 10; ++i) {  // the stress is linear along the edge
      const Eigen::Vector3d stress = (1 - i / 10.) * solution.stress[t].col(3 * k) +
                                     i / 10. * solution.stress[t].col(3 * k + 1);
      const Eigen::Vector2d force = frame.length_mm / 2 * traction(stress, frame.normal);
      const double normal = force.dot(frame.normal), tangential = force.dot(frame.tangent);
      EXPECT_LE(normal, 1e-9 * largest);
      EXPECT_LE(std::abs(tangential), -problem->friction_at(row) * normal + 1e-9 * largest);
    }
  });
}

TEST_P(EveryKindOfMethod, TwoMaterialsAndStiffContrastAgreeWithAnotherKindOfMethod) {
  Mesh mesh = small_tooth(6, 5);
  mesh.body_names = {"root", "tip"};
  for (std::size_t t = mesh.triangles.size() / 2; t < mesh.triangles.size(); ++t)
    mesh.triangle_body[t] = 1;
  Scene scene;
  scene.materials["tip"] = {2100, 0.45};
  const auto problem = posed(scene, mesh);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Solution other = other_answer(problem);
  EXPECT_LE(testing::distance(solution.F_C, other.F_C), 1e-8 * other.F_C.norm());
}

TEST_P(EveryKindOfMethod, ReactionsAndContactForcesBalanceTheBodyForce) {
  for (const double mu : {0.2, 0.0}) {
    Scene scene;
    scene.friction = mu;
    scene.body_force_N_per_mm3 = {3, -1};
    const auto problem = posed(scene);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    Eigen::Vector2d reactions = Eigen::Vector2d::Zero(), contact = Eigen::Vector2d::Zero();
    testing::visit_boundary(*problem, [&](int row, int t, int k) {
      if (problem->mesh.boundary[row].role == BoundaryRole::displacement)
        reactions +=
            element_edge_forces(problem->vertices_of(t), solution.stress[t], k).rowwise().sum();
    });
    for (int p = 0; p < system_->contact.count; ++p)  // n = x, s = y on the tip
      for (int k = 0; k < system_->contact.components; ++k)
        contact(k) += solution.F_C(system_->contact.components * p + k);
    const Eigen::Vector2d weight = 80 * scene.body_force_N_per_mm3;  // 80 mm² of body
    EXPECT_LT((reactions + contact + weight).norm(), 1e-9 * reactions.norm()) << mu;
  }
}

TEST_P(EveryKindOfMethod, ABodyFarFromTheOriginHasTheSameAnswer) {
  testing::expect_the_same_far_from_the_origin([&](const auto& problem) { return solve(problem); });
}

TEST_P(EveryKindOfMethod, OutOfTimeIsATimeout) {
  const Solution solution = solve(posed({}), testing::out_of_time());
  EXPECT_EQ(solution.status, Status::timeout);
  EXPECT_NE(solution.message.find("time limit reached during"), std::string::npos);
}

TEST_P(EveryKindOfMethod, TooFewSweepsIsNotConverged) {
  if (!GetParam().condenses_contact()) GTEST_SKIP() << "it makes no sweeps";
  RunControl control;
  control.contact = {.solver = ContactSolver::gauss_seidel, .max_iterations = 1};
  const Solution solution = solve(posed({}), control);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_NE(solution.message.find("natural map residual"), std::string::npos);
  control.contact.solver = ContactSolver::newton;  // it needs no more sweeps
  EXPECT_EQ(solve(posed({}), control).status, Status::ok);
}

}  // namespace
}  // namespace airybench::methods_test
