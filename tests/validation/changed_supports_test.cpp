// Load steps that hold what was loaded, or load what was held.
#include <gtest/gtest.h>

#include "assembly/problem/pose.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/posed.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::changed_supports_test {
namespace {

using Eigen::Vector2d;
using testing::posed;

LinearValue<Vector2d> everywhere(const Vector2d& value) { return {{value, value}}; }

LoadStep loaded(const std::string& group, const Vector2d& traction_MPa) {
  LoadStep step;
  step.boundary[group].traction_MPa = everywhere(traction_MPa);
  return step;
}
LoadStep moved(const std::string& group, const Vector2d& displacement_mm) {
  LoadStep step;
  step.boundary[group].displacement_mm = everywhere(displacement_mm);
  return step;
}

struct Step {
  ContactSystem system;
  Solution solution;
  const Problem& problem() const { return *system.problem; }
  double dissipation() const { return dissipation_Nmm(system, solution); }
};
std::vector<Step> steps_by(const Method& method, const std::shared_ptr<const Problem>& first) {
  RunControl tight;
  tight.tolerance = 1e-12;
  std::vector<Step> steps;
  solve_load_steps(method, first, tight,
                   [&](int step, const ContactSystem& system, const Solution& answer) {
                     EXPECT_EQ(answer.status, Status::ok) << step << ": " << answer.message;
                     steps.push_back({system, answer});
                   });
  EXPECT_EQ(steps.size(), first->later_steps.size() + 1);
  return steps;
}

double apart(const Step& a, const Step& b) {
  return stress_distance(a.problem(), a.solution.stress, b.solution.stress) /
         std::sqrt(stress_norm_squared(a.problem(), b.solution.stress));
}

// The traction on the boundary of stresses of degree 1, on the chords.
auto reaction(const Step& step) {
  auto ends = std::make_shared<std::map<std::pair<int, bool>, Vector2d>>();
  const Problem& problem = step.problem();
  testing::visit_boundary(problem, [&](int row, int t, int k) {
    const auto [a, b] = problem.mesh.boundary[static_cast<std::size_t>(row)].vertices;
    const auto F = element_edge_forces(problem.vertices_of(t), step.solution.stress[t], k);
    const double length = (problem.mesh.vertices[b] - problem.mesh.vertices[a]).norm();
    for (const bool end : {false, true}) (*ends)[{row, end}] = 2 / length * F.col(end);
  });
  return [ends, mesh = problem.mesh](const Vector2d& x, const Vector2d&, int row) -> Vector2d {
    const auto [start, end] = mesh.boundary[static_cast<std::size_t>(row)].vertices;
    const Vector2d a = mesh.vertices[start], along = mesh.vertices[end] - a;
    const double s = along.dot(x - a) / along.squaredNorm();
    return (1 - s) * ends->at({row, false}) + s * ends->at({row, true});
  };
}

// The tooth, whose root is held in two halves.
Mesh tooth() {
  Mesh mesh = testing::small_tooth(6, 6);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::displacement && mesh.vertices[edge.vertices[0]].y() > 1e-9)
      edge.group = boundary_group(mesh, "half");
  return mesh;
}

// A block 12 × 5 mm on a flat wall, its head held, its sides on rollers or free.
Mesh block(const std::string& sides = "force") {
  Mesh mesh;
  mesh.name = "block";
  testing::add_block(mesh, "block", {0, 0}, {12, 5}, 6, 3,
                     {"contact", sides, "displacement:head", sides});
  validate(mesh);
  return mesh;
}
Scene on_wall(double friction, const Vector2d& head_mm) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.friction = friction;
  scene.boundary["displacement:head"].displacement_mm = everywhere(head_mm);
  return scene;
}
Scene between_rollers(double friction, double down_mm) {
  Scene scene = on_wall(friction, {0, -down_mm});
  scene.boundary["displacement:head"].support = BoundaryValues::Support::normal;
  scene.boundary["displacement:side"].support = BoundaryValues::Support::normal;
  scene.boundary["displacement:side"].displacement_mm = everywhere({0, 0});
  return scene;
}
// σ_yy = −p of strain −down/5, nothing across.
double pressure_MPa(double down_mm) {
  const Material steel;
  const double nu = steel.poisson;
  return steel.young_MPa * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) * down_mm / 5;
}

bool releases_bodies(const Method& method) {
  return method.condenses_contact() && method.name != "HYBRID:CG";
}

double largest_off(const Step& step, const Eigen::Vector3d& stress_MPa) {
  double off = 0;
  for (int t = 0; t < static_cast<int>(step.solution.stress.size()); ++t)
    off = std::max(off, (step.solution.stress[t].colwise() - stress_MPa).cwiseAbs().maxCoeff());
  return off;
}

class ChangedSupports : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(
    Methods, ChangedSupports,
    ::testing::ValuesIn(select_methods(testing::hybrid_of_every_degree() +
                                       ",HYBRID:CG,P2,P3,P4,3STEPD:CHOLMOD,3STEPD:REFINED,"
                                       "BLIND:SCHUR,ALM:AUTO,SSKY")),
    testing::readable);

// Loaded by the reaction of the step before nothing changes, with and without friction: half of the
// root, and all of it, after which contact alone holds the tooth.
TEST_P(ChangedSupports, TheReactionInPlaceOfTheDisplacementChangesNothing) {
  if (GetParam().degree > 1 || GetParam().in_displacements()) GTEST_SKIP() << "not linear on edges";
  for (const double friction : {0., 0.2})
    for (const bool of_all : {false, true}) {
      if (of_all && !releases_bodies(GetParam())) continue;
      Scene scene;
      scene.friction = friction;
      LoadStep step = loaded("displacement:half", {1, 0});
      if (of_all) step.boundary["displacement"] = step.boundary["displacement:half"];
      scene.later_steps = {step, step};
      auto problem = std::make_shared<Problem>(pose(scene, tooth()));
      const Step held = steps_by(select_methods("3STEPD:REFINED").front(), problem).front();
      for (Loads& later : problem->later_steps) later.traction_MPa = reaction(held);
      EXPECT_EQ(has_free_motions(*problem), of_all);
      const std::vector<Step> steps = steps_by(GetParam(), problem);
      for (const std::size_t k : {1U, 2U}) {
        EXPECT_LT(apart(steps[k], steps[0]), 1e-6) << friction << " " << of_all << " " << k;
        EXPECT_LT(testing::distance(steps[k].solution.F_C, steps[0].solution.F_C),
                  1e-6 * steps[0].solution.F_C.norm());
        EXPECT_LT(steps[k].dissipation(), 1e-6 * (steps[0].dissipation() + 1e-3));
      }
    }
}

// Moved by 0.01 mm, loaded by its pressure and by twice as much, unloaded, moved again: uniform.
TEST_P(ChangedSupports, AUniformStateIsThatOfTheLoad) {
  const double p = pressure_MPa(0.01);
  for (const double friction : {0., 0.3}) {
    Scene scene = between_rollers(friction, 0.01);
    scene.later_steps = {
        loaded("displacement:head", {0, -p}), loaded("displacement:head", {0, -2 * p}),
        loaded("displacement:head", {0, 0}), moved("displacement:head", {0, -0.03})};
    if (!releases_bodies(GetParam())) continue;  // contact alone holds it along the side rollers
    const std::vector<Step> steps = steps_by(GetParam(), posed(scene, block("displacement:side")));
    ASSERT_EQ(steps.size(), 5U);
    const std::array factors = {1., 1., 2., 0., 3.};
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_LT(largest_off(steps[k], factors[k] * Eigen::Vector3d(-0.3 / 0.7 * p, -p, 0)),
                1e-6 * p)
          << friction << " step " << k;
  }
}

// Without contact: a bar that is pulled by 0.01 mm, let go, pulled by a force, and held again.
TEST_P(ChangedSupports, ABarThatIsLetGoHasNoStress) {
  Mesh mesh;
  mesh.name = "bar";
  testing::add_block(
      mesh, "bar", {0, 0}, {10, 4}, 5, 3,
      {"displacement:below", "displacement:end", "force:above", "displacement:left"});
  Scene scene;
  for (const char* group : {"displacement:below", "displacement:end", "displacement:left"}) {
    scene.boundary[group].support = BoundaryValues::Support::normal;
    scene.boundary[group].displacement_mm = everywhere({0, 0});
  }
  scene.boundary["displacement:end"].displacement_mm = everywhere({0.01, 0});
  LoadStep clamped = moved("displacement:end", {-0.01, 0});
  clamped.boundary["force:above"] = moved("", {0, 0}).boundary[""];  // as well, on a roller
  clamped.boundary["force:above"].support = BoundaryValues::Support::normal;
  scene.later_steps = {loaded("displacement:end", {0, 0}), loaded("displacement:end", {70, 0}),
                       clamped, loaded("force:above", {0, 0})};
  const Material steel;
  const double nu = steel.poisson, unit = steel.young_MPa / (1 - nu * nu) * 0.001,
               clamped_MPa = -pressure_MPa(0.005);  // strain 1e-3
  const std::vector<Step> steps = steps_by(GetParam(), posed(scene, mesh));
  ASSERT_EQ(steps.size(), 5U);
  const std::array<Eigen::Vector3d, 5> exact = {
      Eigen::Vector3d(unit, 0, 0), Eigen::Vector3d::Zero(), Eigen::Vector3d(70, 0, 0),
      Eigen::Vector3d(clamped_MPa, nu / (1 - nu) * clamped_MPa, 0), Eigen::Vector3d(-unit, 0, 0)};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_LT(largest_off(steps[k], exact[k]), 1e-6 * unit) << k;
}

// Pressed and sheared, then held by forces alone: these are what the wall bears, and the slip of
// the first step stays in the second. All degrees agree but for the mesh.
TEST_P(ChangedSupports, FrictionRemembersAcrossTheChange) {
  if (!releases_bodies(GetParam())) GTEST_SKIP() << "contact alone holds the block";
  Scene scene = on_wall(0.3, {0.006, -0.01});
  const Vector2d t(40, -400);
  scene.later_steps = {loaded("displacement:head", t), loaded("displacement:head", {-40, -400}),
                       moved("displacement:head", {0, -0.01})};
  const auto problem = posed(scene, block());
  const std::vector<Step> steps = steps_by(GetParam(), problem),
                          best = steps_by(select_methods("HYBRID:k=4").front(), problem);
  ASSERT_EQ(steps.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto sum = [](const Step& step) {
      const Eigen::VectorXd& F = step.solution.F_C;
      return Vector2d(F(Eigen::seq(1, Eigen::last, 2)).sum(),
                      F(Eigen::seq(0, Eigen::last, 2)).sum());
    };
    // On the wall below the tangent is x and the normal −y.
    if (k == 1 || k == 2) {
      EXPECT_NEAR(sum(steps[k]).x(), k == 1 ? -40 * 12 : 40 * 12, 1e-6 * 400 * 12) << k;
      EXPECT_NEAR(sum(steps[k]).y(), -400 * 12, 1e-6 * 400 * 12) << k;
    } else {
      EXPECT_LT((sum(steps[k]) - sum(best[k])).norm(), 0.05 * sum(best[k]).norm()) << k;
    }
    EXPECT_GE(steps[k].dissipation(), -1e-9);
  }
}

// A corner of the floor moves with the side that is held, then lets go: it slips from there.
TEST_P(ChangedSupports, ACornerThatWasHeldHasSlipped) {
  Mesh mesh;
  mesh.name = "block";
  testing::add_block(mesh, "block", {0, 0}, {12, 5}, 12, 5,
                     {"contact", "displacement:right", "displacement:head", "force"});
  Scene scene = on_wall(0.6, {0.004, -0.01});
  scene.boundary["displacement:right"].displacement_mm = {
      {Vector2d(0.006, 0), Vector2d(0.004, -0.01)}, {Vector2d(12, 0), Vector2d(12, 5)}};
  scene.later_steps = {loaded("displacement:right", {0, 0}),
                       moved("displacement:head", {0.004, -0.011})};
  const auto problem = posed(scene, mesh);
  const std::vector<Step> steps = steps_by(GetParam(), problem),
                          best = steps_by(select_methods("HYBRID:k=4").front(), problem);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto tangential = [](const Step& step) {
      return step.solution.F_C(Eigen::seq(1, Eigen::last, 2)).sum();
    };
    EXPECT_NEAR(tangential(steps[k]), tangential(best[k]), 0.1 * std::abs(tangential(best[0])))
        << k;
  }
}

// Without friction bounds are guaranteed on both sides of the change.
TEST(ChangedSupportsOf, StressesOfEveryDegreeHaveGuaranteedBounds) {
  for (int k = 1; k <= highest_stress_degree; ++k) {
    Scene scene = on_wall(0, {0, -0.01});
    scene.later_steps = {loaded("displacement:head", {0, -400})};
    scene.later_steps.front().boundary["displacement:head"].traction_MPa = {
        {Vector2d(0, -100), Vector2d(0, -500)}, {Vector2d(0, 5), Vector2d(12, 5)}};
    for (const Step& step :
         steps_by(select_methods(hybrid_of_degree(k)).front(), posed(scene, block()))) {
      const ConstitutiveError error =
          constitutive_error(step.system, step.solution.stress, step.solution.F_C,
                             recovered_displacement(step.system, step.solution));
      EXPECT_EQ(error.flaw, "");
      EXPECT_TRUE(error.guaranteed);
      EXPECT_LT(error.relative, 0.5);
    }
  }
}

// A function that solves is the same one before and after.
TEST(ChangedSupportsOf, AFunctionWithAStateKeepsIt) {
  Scene scene = on_wall(0.3, {0.006, -0.01});
  scene.later_steps = {loaded("displacement:head", {40, -400}),
                       loaded("displacement:head", {40, -400}),
                       moved("displacement:head", {0, -0.01})};
  ContactSystem system = contact_system(posed(scene, block()));
  std::vector<int> counted;
  const Solve solve = [&counted, count = 0, hybrid = select_methods("HYBRID").front()](
                          const ContactSystem& of_step, const RunControl& control) mutable {
    counted.push_back(count++);
    Solution answer = hybrid.solve(of_step, control);
    answer.solve_again = nullptr;
    return answer;
  };
  solve_load_steps(solve, system, {});
  EXPECT_EQ(counted, (std::vector{0, 1, 2, 3}));
}

// Such a step has no middle: it comes whole, and again.
TEST(ChangedSupportsOf, HalvedPathsAreNotHalved) {
  Scene scene = on_wall(0.3, {0.006, -0.01});
  scene.later_steps = {loaded("displacement:head", {40, -400}),
                       loaded("displacement:head", {0, -800})};
  const Problem halves = with_half_steps(*posed(scene, block()));
  ASSERT_EQ(halves.later_steps.size(), 5U);
  int head = 0;
  while (halves.mesh.boundary[static_cast<std::size_t>(head)].role != BoundaryRole::displacement)
    ++head;
  EXPECT_TRUE(halves.later_steps[0].roles.empty());
  for (const std::size_t k : {1U, 2U, 3U, 4U})
    EXPECT_EQ(halves.later_steps[k].roles[static_cast<std::size_t>(head)], BoundaryRole::force);
  const auto down = [&](std::size_t k) {
    return halves.later_steps[k].traction_MPa({6, 5}, {0, 1}, head).y();
  };
  EXPECT_EQ(down(1), -400);
  EXPECT_EQ(down(2), -400);
  EXPECT_EQ(down(3), -600);
  EXPECT_EQ(down(4), -800);
}

TEST(ChangedSupportsOf, WhatASceneCannotSayIsNamed) {
  const auto complaint = [](const LoadStep& step, const Mesh& mesh, const Scene& of) {
    Scene scene = of;
    scene.later_steps = {step};
    return testing::complaint_of<SceneError>([&] { pose(scene, mesh); });
  };
  const Scene scene = on_wall(0, {0, -0.01});
  LoadStep both = loaded("displacement:head", {0, 1});
  both.boundary["displacement:head"].displacement_mm = everywhere({0, 0});
  testing::expect_named(complaint(both, block(), scene),
                        {"load_steps: 1: boundary: displacement:head",
                         "displacement_mm and traction_MPa (allowed: either"});
  LoadStep rolling = loaded("displacement:head", {0, 1});
  rolling.boundary["displacement:head"].support = BoundaryValues::Support::normal;
  testing::expect_named(complaint(rolling, block(), scene),
                        {"load_steps: 1: boundary", "support (allowed: with displacement_mm)"});
  testing::expect_named(complaint(moved("contact", {0, 1}), block(), scene),
                        {"contact: displacement_mm (allowed: on a displacement boundary)"});
  Mesh alone;
  alone.name = "alone";
  testing::add_block(alone, "block", {0, 0}, {1, 1}, 2, 2,
                     {"displacement:head", "force", "force", "force"});
  testing::expect_named(complaint(loaded("displacement:head", {0, 0}), alone, scene),
                        {"load_steps: 1: mesh alone: no displacement and no contact edge"});
}

}  // namespace
}  // namespace airybench::changed_supports_test
