// Methods on small systems: exact fields, scenes, and injected failures. Each kind of method is
// there once, the preconditioned ones with one preconditioner of every kind; all of them are in
// product_test.cpp.
#include "solvers/methods.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "assembly/edge_forces.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::methods_test {

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace {

using testing::posed;
using testing::scene_variants;
using testing::small_tooth;

std::vector<Method> kinds_of_methods() {
  std::vector<Method> kinds;
  for (const Method& method : methods())  // displacements: quadratic_displacements_test.cpp
    if (!method.is_iterative() && !method.in_displacements) kinds.push_back(method);
  for (const char* name : {"HYBRID:CG", "ALM:r=20,rho=20", "ALM:AUTO", "SYMMLQ:DTIC4,lanes=1",
                           "3STEPCG:DTIC4,lanes=1", "SYMMLQ:DTIC3", "SYMMLQ:FLIC2", "SYMMLQ:SKY",
                           "3STEPCG:DTIC3", "3STEPCG:FLIC2", "3STEPCG:SKY"})
    kinds.push_back(select_methods(name).front());
  if (testing::sanitized) return kinds;
  // Thousands of iterations; preconditioners_test has these, too.
  for (const char* name : {"SYMMLQ:SKY,schur=sparse", "SYMMLQ:SSOR1.0", "SYMMLQ:NONE",
                           "3STEPCG:SSOR1.0", "3STEPCG:NONE"})
    kinds.push_back(select_methods(name).front());
  return kinds;
}

class EveryKindOfMethod : public ::testing::TestWithParam<Method> {
 protected:
  // Iterative methods as far as rounding lets them go.
  static RunControl tight() {
    RunControl control;
    control.tolerance = 1e-13;
    return control;
  }
  Solution solve(std::shared_ptr<const Problem> problem, const RunControl& control = tight()) {
    system_ = assemble(std::move(problem), GetParam().blocks);
    return run(GetParam(), system_, control);
  }
  // The largest deviation from an exact stress, relative to its largest value.
  static double deviation(const Problem& problem, const StressField& field,
                          const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& exact) {
    double worst = 0, size = 0;
    for (int t = 0; t < static_cast<int>(field.size()); ++t) {
      const TriangleVertices v = problem.vertices_of(t);
      for (int c = 0; c < 9; ++c) {
        const Eigen::Vector2d x = c % 3 == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                             : Eigen::Vector2d(v.col((c / 3 + c % 3) % 3));
        worst = std::max(worst, (field[t].col(c) - exact(x)).cwiseAbs().maxCoeff());
        size = std::max(size, exact(x).cwiseAbs().maxCoeff());
      }
    }
    return worst / size;
  }
  // The answer of a method of another kind.
  static Solution other_answer(const std::shared_ptr<const Problem>& problem) {
    const Method other = select_methods(GetParam().name == "HYBRID" ? "3STEPD" : "HYBRID").front();
    return run(other, assemble(problem, other.blocks), {});
  }
  DualSystem system_;
};
INSTANTIATE_TEST_SUITE_P(Table, EveryKindOfMethod, ::testing::ValuesIn(kinds_of_methods()),
                         testing::readable);

TEST_P(EveryKindOfMethod, ReproducesLinearStressesExactlyWithoutContact) {
  Mesh mesh = small_tooth(5, 4);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) edge.role = BoundaryRole::force;
  constexpr double young = 2000, poisson = 0.3;
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-10) << exact.name;
    EXPECT_FALSE(solution.contact_iterations) << exact.name;
    EXPECT_FALSE(solution.times[Stage::contact]) << exact.name;
  }
}

TEST_P(EveryKindOfMethod, ReproducesLinearStressesExactlyWithNoConstraintAtAll) {
  Mesh mesh = small_tooth(5, 4);
  for (BoundaryEdge& edge : mesh.boundary) edge.role = BoundaryRole::displacement;
  constexpr double young = 2000, poisson = 0.3;
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << exact.name << ": " << solution.message;
    EXPECT_EQ(system_.n_f() + system_.n_c(), 0);
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-10) << exact.name;
  }
}

TEST_P(EveryKindOfMethod, ReproducesAConstantStressThatSticksOrSlipsOnTheWall) {
  // A flat wall at x = 10: u_n = 0 there. σ = (−100, σyy, τ) with εyy = 0 sticks for |τ| < 100 μ;
  // for τ = 100 μ it slips by any amount against the friction.
  constexpr double young = 2000, poisson = 0.3, mu = 0.25;
  const Eigen::Matrix3d c = compliance({young, poisson}, Plane::stress);
  for (const auto& [tau, slip] : {std::pair{10.0, 0.0}, {-20.0, 0.0}, {25.0, -0.5}, {-25.0, 0.3}}) {
    const Eigen::Vector3d stress(-100, -100 * poisson, tau);
    const Eigen::Vector3d strain = c * stress;
    testing::ExactField exact;
    exact.body_force.setZero();
    exact.stress = [=](const Eigen::Vector2d&) { return stress; };
    exact.displacement = [=, slid = slip](const Eigen::Vector2d& x) {
      return Eigen::Vector2d(strain(0) * (x.x() - 10), strain(2) * (x.x() - 10) + slid);
    };
    const auto problem = std::make_shared<const Problem>(
        make_problem(small_tooth(5, 4), {c}, testing::loads_of(exact), mu));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-9) << tau;
    for (int p = 0; p < system_.contact.count; ++p) {  // four edges of 1.5 mm
      EXPECT_NEAR(solution.F_C(2 * p), -75, 1e-7);
      EXPECT_NEAR(solution.F_C(2 * p + 1), 0.75 * tau, 1e-7);
    }
  }
}

TEST_P(EveryKindOfMethod, AgreesWithAnotherKindOfMethodOnEveryScene) {
  int turn = 0;
  for (const auto& [name, scene] : scene_variants()) {
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
  for (const char* name : {"no load", "nothing touches", "pulled away"}) {
    const testing::NamedScenes variants = scene_variants();
    const auto variant = std::find_if(variants.begin(), variants.end(),
                                      [&](const auto& v) { return v.first == name; });
    const auto problem = posed(variant->second);
    const Solution solution = solve(problem);
    EXPECT_TRUE(solution.F_C.isZero(0)) << name;
    EXPECT_LT(std::sqrt(stress_norm_squared(*problem, solution.stress)), 1e-9) << name;
  }
}

TEST_P(EveryKindOfMethod, StressIsStrictlyAdmissibleOnWholeContactEdges) {
  const auto problem = posed({});
  const Solution solution = solve(problem);
  const double largest = solution.F_C.cwiseAbs().maxCoeff();
  for (std::size_t row = 0; row < problem->mesh.boundary.size(); ++row) {
    if (problem->mesh.boundary[row].role != BoundaryRole::contact) continue;
    const int edge = problem->edges.of_boundary[row];
    const double mu = problem->friction_at(static_cast<int>(row));
    for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (problem->edges.of_triangle[t][k] != edge) continue;
        const TriangleVertices v = problem->vertices_of(t);
        const EdgeFrame frame = edge_frame(v.col(k), v.col((k + 1) % 3));
        for (int i = 0; i <= 10; ++i) {  // the stress is linear along the edge
          const Eigen::Vector3d stress = (1 - i / 10.) * solution.stress[t].col(3 * k) +
                                         i / 10. * solution.stress[t].col(3 * k + 1);
          const Eigen::Vector2d force = frame.length_mm / 2 * traction(stress, frame.normal);
          const double normal = force.dot(frame.normal), tangential = force.dot(frame.tangent);
          EXPECT_LE(normal, 1e-9 * largest);
          EXPECT_LE(std::abs(tangential), -mu * normal + 1e-9 * largest);
        }
      }
    }
  }
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
    for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < problem->mesh.boundary.size(); ++row)
          if (problem->edges.of_boundary[row] == problem->edges.of_triangle[t][k] &&
              problem->mesh.boundary[row].role == BoundaryRole::displacement)
            reactions +=
                element_edge_forces(problem->vertices_of(t), solution.stress[t], k).rowwise().sum();
    for (int p = 0; p < system_.contact.count; ++p)  // n = x, s = y on the tip
      for (int k = 0; k < system_.contact.components; ++k)
        contact(k) += solution.F_C(system_.contact.components * p + k);
    const Eigen::Vector2d weight = 80 * scene.body_force_N_per_mm3;  // 80 mm² of body
    EXPECT_LT((reactions + contact + weight).norm(), 1e-9 * reactions.norm()) << mu;
  }
}

TEST_P(EveryKindOfMethod, ABodyFarFromTheOriginHasTheSameAnswer) {
  Mesh moved = small_tooth(6, 5);
  for (Eigen::Vector2d& x : moved.vertices) x += Eigen::Vector2d(1e5, -2e5);
  Scene scene;
  scene.crown_radius_mm.reset();
  const Solution here = solve(posed(scene)), there = solve(posed(scene, moved));
  ASSERT_EQ(there.status, Status::ok) << there.message;
  // The moved coordinates themselves are rounded to 3e-11 mm.
  EXPECT_LT(testing::distance(here.F_C, there.F_C), 1e-8 * here.F_C.norm());
}

TEST_P(EveryKindOfMethod, OutOfTimeIsATimeout) {
  RunControl control;
  control.deadline = Deadline::after(-1);
  const Solution solution = solve(posed({}), control);
  EXPECT_EQ(solution.status, Status::timeout);
  EXPECT_NE(solution.message.find("time limit reached during"), std::string::npos);
}

TEST_P(EveryKindOfMethod, TooFewSweepsIsNotConverged) {
  if (GetParam().name.starts_with("ALM") || GetParam().name == "HYBRID:CG")
    GTEST_SKIP() << "it makes no sweeps";
  RunControl control;
  control.contact_sweeps = 1;
  control.contact = ContactSolver::gauss_seidel;
  const Solution solution = solve(posed({}), control);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_NE(solution.message.find("natural map residual"), std::string::npos);
  control.contact = ContactSolver::newton;  // it needs no more sweeps
  EXPECT_EQ(solve(posed({}), control).status, Status::ok);
}

TEST_P(EveryKindOfMethod, CountsItsStorage) { EXPECT_GT(matrix_bytes(solve(posed({}))), 0u); }

}  // namespace
}  // namespace airybench::methods_test
