// ALM:AUTO, and the acceleration it is made of.
#include "solvers/uzawa/accelerated_lagrangian.hpp"

#include <gtest/gtest.h>

#include "assembly/scene.hpp"
#include "solvers/base/anderson_acceleration.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::accelerated_lagrangian_test {
namespace {

using testing::named_scenes;
using testing::NamedScenes;
using testing::system_of;

Solution solve(const DualSystem& system, const RunControl& control = {},
               const char* method = "ALM:AUTO") {
  return run(select_methods(method).front(), system, control);
}

double force_error(const Solution& solution, const Solution& reference) {
  return testing::distance(solution.F_C, reference.F_C) / reference.F_C.norm();
}

NamedScenes scenes() {
  return named_scenes({
      {"default", [](Scene&) {}},
      {"frictionless", [](Scene& s) { s.friction = 0; }},
      {"friction 1",
       [](Scene& s) {
         s.friction = 1;
         s.displacement_mm = {0.015, 0.02};
         s.crown_radius_mm = 200;
       }},
      {"friction 3",
       [](Scene& s) {
         s.friction = 3;
         s.displacement_mm = {0.01, 0.03};
         s.crown_radius_mm = 200;
       }},
      {"body force",
       [](Scene& s) {
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"clearance", [](Scene& s) { s.clearance_mm = 0.005; }},
      {"flat wall", [](Scene& s) { s.crown_radius_mm.reset(); }},
      {"layers",
       [](Scene& s) {
         s.layers.count = 3;
         s.layer_materials = {{210000, 0.3}, {2100, 0.45}};
       }},
  });
}

TEST(AcceleratedLagrangian, FindsTheReferenceOnEverySceneInFewIterations) {
  for (const auto& [name, scene] : scenes()) {
    const DualSystem system = system_of(scene);
    const Solution solution = solve(system), reference = solve(system, {}, "HYBRID");
    ASSERT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    EXPECT_LT(force_error(solution, reference), 1e-7) << name;
    EXPECT_LT(stress_distance(*system.problem, solution.stress, reference.stress), 1e-5) << name;
    EXPECT_LE(solution.uzawa_iterations, 150) << name;
  }
}

// The grid's parameters are best where its mean weights fit; here edges differ by a factor of 100.
TEST(AcceleratedLagrangian, PenaltiesFollowGradedEdgesAndMaterials) {
  Scene scene;
  scene.mesh.grade = Grading{{10, 3}, 100};
  scene.material.young_MPa = 3;
  const DualSystem system = system_of(scene);
  const Solution solution = solve(system), reference = solve(system, {}, "HYBRID");
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LT(force_error(solution, reference), 1e-6);
  EXPECT_LE(solution.uzawa_iterations, 150);
}

TEST(AcceleratedLagrangian, ThePenaltyIsOfTheRowsOwnSize) {
  const DualSystem system = system_of();
  const Eigen::VectorXd R = row_penalties(system, 10, 3);
  ASSERT_EQ(R.size(), system.n_f() + system.n_c());
  EXPECT_DOUBLE_EQ(R(0), 10 / system.C_F.row(0).squaredNorm());
  EXPECT_DOUBLE_EQ(R(system.n_f()), 3 / system.C_C.row(0).squaredNorm());
  const SparseColumns lower = penalised_matrix(system, R);
  EXPECT_EQ(lower.nonZeros(), system.S.nonZeros());
}

TEST(AcceleratedLagrangian, ATighterToleranceIsASmallerError) {
  const DualSystem system = system_of();
  const Solution reference = solve(system, {}, "HYBRID");
  double before = 1;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    RunControl control;
    control.tolerance = tolerance;
    const double error = force_error(solve(system, control), reference);
    EXPECT_LT(error, before / 10) << tolerance;
    before = error;
  }
}

TEST(AcceleratedLagrangian, ItsOwnEstimateIsNotBelowItsError) {
  const DualSystem system = system_of();
  const Solution reference = solve(system, {}, "HYBRID");
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    RunControl control;
    control.tolerance = tolerance;
    const Solution solution = solve(system, control);
    const double error = stress_distance(*system.problem, solution.stress, reference.stress) /
                         std::sqrt(stress_norm_squared(*system.problem, reference.stress));
    EXPECT_GT(solution.error_estimate.value(), error) << tolerance;
    EXPECT_EQ(solution.status,
              *solution.error_estimate <= control.target_error ? Status::ok : Status::inaccurate);
  }
}

TEST(AcceleratedLagrangian, BelowRoundingItEndsAndTheCheckJudges) {
  RunControl control;
  control.tolerance = 1e-16;
  const Solution solution = solve(system_of(), control);
  EXPECT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LT(solution.uzawa_iterations, 1000);
}

TEST(AcceleratedLagrangian, TooFewIterationsAreNotConvergedWithTheirNumbers) {
  RunControl control;
  control.uzawa_iterations = 3;
  const Solution solution = solve(system_of(), control);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_NE(solution.message.find("after 3 iterations"), std::string::npos) << solution.message;
}

TEST(AcceleratedLagrangian, ThePapersStopIsIts) {
  RunControl control;
  control.stop = Stop::paper;
  control.histories = true;
  const Solution solution = solve(system_of(), control);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LE(solution.histories.front().residual.back(), UzawaOptions::paper_stop_N);
}

TEST(AcceleratedLagrangian, WhatIsNotFiniteIsNoSuccess) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    DualSystem system = system_of();
    system.q = Eigen::VectorXd::Constant(system.n(), poison);
    EXPECT_EQ(solve(system).status, Status::not_converged);
    system = system_of();
    system.S.valuePtr()[5] = poison;
    EXPECT_EQ(solve(system).status, Status::breakdown);
  }
}

TEST(AcceleratedLagrangian, WithoutLoadThereIsNothingToDo) {
  Scene scene;
  scene.displacement_mm.setZero();
  const Solution solution = solve(system_of(scene));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_TRUE(solution.F_C.isZero(0));
  EXPECT_TRUE(solution.phi.isZero(0));
  EXPECT_EQ(solution.uzawa_iterations, 1);
}

// A linear map is solved as by GMRES: in about as many steps as it has unknowns.
TEST(AndersonAcceleration, SolvesALinearMapInAsManyStepsAsUnknowns) {
  constexpr int n = 6;
  std::mt19937 generator(1);
  const Eigen::MatrixXd A = 0.4 * testing::random_matrix(n, n, generator);
  const Eigen::VectorXd b = testing::random_matrix(n, 1, generator);
  const Eigen::VectorXd exact = testing::solved(Eigen::MatrixXd::Identity(n, n) - A, b);
  AndersonAcceleration acceleration(n, n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < n + 4; ++k) {
    const Eigen::VectorXd g = A * x + b;
    x = acceleration.next(g, g - x);
    smallest = std::min(smallest, testing::distance(x, exact) / exact.norm());
  }
  EXPECT_LT(smallest, 1e-9);
}

TEST(AndersonAcceleration, GoesBackToTheBestWhenTheResidualGrows) {
  AndersonAcceleration acceleration(1, 3);
  const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value).eval(); };
  EXPECT_EQ(acceleration.next(one(5), one(1))(0), 5);    // a plain step
  EXPECT_EQ(acceleration.next(one(7), one(2.5))(0), 5);  // grown: from the best again
  EXPECT_EQ(acceleration.next(one(6), one(2.4))(0), 6);  // plain, nothing is remembered
  acceleration.forget();
  EXPECT_EQ(acceleration.next(one(9), one(100))(0), 9);
}

}  // namespace
}  // namespace airybench::accelerated_lagrangian_test
