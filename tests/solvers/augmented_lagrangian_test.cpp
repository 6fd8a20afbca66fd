// ALM with parameters of the grid, ALM:AUTO, and the acceleration that the latter is made of.
#include "solvers/uzawa/augmented_lagrangian.hpp"

#include <gtest/gtest.h>

#include <set>

#include "assembly/problem/scene.hpp"
#include "solvers/base/anderson_acceleration.hpp"
#include "solvers/uzawa/accelerated_lagrangian.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::augmented_lagrangian_test {
namespace {

using testing::force_error, testing::solved_by, testing::system_of, testing::with_tolerance;

Tuning tune(const AirySystem& system, const RunControl& control) {
  return select_methods("ALM").front().tune(system, control);
}

void expect_in_cone(const AirySystem& system, const Eigen::VectorXd& F_C) {
  const ContactPoints& contact = system.contact;
  for (int p = 0; p < contact.count; ++p) {
    const double normal = F_C(contact.components * p);
    EXPECT_LE(normal, 0);
    if (contact.components == 2) {
      EXPECT_LE(std::abs(F_C(2 * p + 1)), -contact.friction_at(p) * normal * (1 + 1e-15));
    }
  }
}

const std::string grid_point = "ALM:r=20,rho=20";

class AugmentedLagrangian : public ::testing::TestWithParam<std::string> {
 protected:
  static bool is_automatic() { return GetParam() == "ALM:AUTO"; }
  static Solution solve(const AirySystem& system, const RunControl& control = {}) {
    return solved_by(GetParam(), system, control);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, AugmentedLagrangian, ::testing::Values(grid_point, "ALM:AUTO"),
                         [](const auto& method) {
                           return std::string(method.param == grid_point ? "Grid" : "Automatic");
                         });

TEST_P(AugmentedLagrangian, ConvergesToTheReferenceOnEveryScene) {
  std::vector<std::string> names = {"default",    "frictionless", "frictionless, body force",
                                    "body force", "clearance",    "friction 2"};
  if (is_automatic())
    for (const char* name : {"friction 1, sheared", "friction 3, sheared", "flat face", "layers"})
      names.emplace_back(name);
  const double off = is_automatic() ? 100 : 1;
  for (const auto& [name, scene] : testing::scenes_named(names)) {
    const AirySystem system = system_of(scene);
    const Solution reference = solved_by("HYBRID", system);
    const Solution solution = solve(system, with_tolerance(1e-12 * off));
    ASSERT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    EXPECT_LT(force_error(solution, reference), 1e-9 * off) << name;
    EXPECT_LT(stress_distance(*system.problem, solution.stress, reference.stress), 1e-7 * off)
        << name;
    EXPECT_GT(solution.uzawa_iterations.value(), 1) << name;
    expect_in_cone(system, solution.F_C);
    if (is_automatic())
      EXPECT_LE(solution.uzawa_iterations, 150) << name;
    else
      EXPECT_EQ(solution.parameters, "r=20, rho=20") << name;
  }
}

TEST_P(AugmentedLagrangian, ATighterToleranceIsASmallerErrorAndMoreIterations) {
  const AirySystem system = system_of();
  const Solution reference = solved_by("HYBRID", system);
  double error = 1;
  std::int64_t iterations = 0;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const Solution solution = solve(system, with_tolerance(tolerance));
    EXPECT_LT(force_error(solution, reference), error / 10) << tolerance;
    EXPECT_GT(solution.uzawa_iterations.value(), iterations) << tolerance;
    error = force_error(solution, reference);
    iterations = *solution.uzawa_iterations;
  }
}

TEST_P(AugmentedLagrangian, ThePapersStopIsFeasibilityOnlyAndLeavesALargerError) {
  const AirySystem system = system_of();
  RunControl control = with_tolerance(1e-8);
  control.stop = Stop::paper;
  control.histories = true;
  const Solution paper = solve(system, control);
  ASSERT_EQ(paper.status, Status::ok) << paper.message;
  const std::vector<double>& history = paper.histories.front().residual;
  EXPECT_LE(history.back(), UzawaOptions::paper_stop_N);
  EXPECT_EQ(history.size(), static_cast<std::size_t>(*paper.uzawa_iterations));
  for (std::size_t k = 0; k + 1 < history.size(); ++k)
    EXPECT_GT(history[k], UzawaOptions::paper_stop_N);
  const Solution reference = solved_by("HYBRID", system),
                 target = solve(system, with_tolerance(1e-8));
  EXPECT_GT(force_error(paper, reference), 10 * force_error(target, reference));
}

TEST_P(AugmentedLagrangian, WhatIsNotFiniteIsABreakdown) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    AirySystem system = system_of();
    system.q = Eigen::VectorXd::Constant(system.n(), poison);
    EXPECT_EQ(solve(system).status, Status::breakdown);
    EXPECT_THROW(tune(system, with_tolerance(1e-6)), Breakdown);
    system = system_of();
    system.S.valuePtr()[5] = poison;
    EXPECT_EQ(solve(system).status, Status::breakdown);
  }
}

TEST_P(AugmentedLagrangian, WithoutContactItSolvesTheEqualities) {
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.body_force_N_per_mm3 = {3, -1};
  const AirySystem system = system_of(
      scene,
      testing::with_role(testing::small_tooth(6, 5), BoundaryRole::contact, BoundaryRole::force));
  const Solution reference = solved_by("HYBRID", system);
  const Solution solution = solve(system, with_tolerance(1e-12));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_EQ(solution.F_C.size(), 0);
  EXPECT_LT(stress_distance(*system.problem, solution.stress, reference.stress), 1e-7);
}

TEST_P(AugmentedLagrangian, WithoutLoadThereIsNothingToDo) {
  Scene scene;
  scene.displacement_mm.setZero();
  const Solution solution = solve(system_of(scene));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_TRUE(solution.F_C.isZero(0));
  EXPECT_TRUE(testing::phi(solution).isZero(0));
  EXPECT_EQ(solution.uzawa_iterations, 1);
}

TEST(GridLagrangian, OutOfTimeIsATimeoutOfTuningToo) {
  for (const char* method : {"ALM:r=20,rho=20", "ALM", "ALM:AUTO"})
    EXPECT_EQ(solved_by(method, system_of(), testing::out_of_time()).status, Status::timeout)
        << method;
}

TEST(GridLagrangian, AnyParametersThatConvergeHaveTheSameLimit) {
  const AirySystem system = system_of();
  const Solution reference = solved_by("HYBRID", system);
  for (const char* method :
       {"ALM:r=5,rho=5", "ALM:r=60,rho=60", "ALM:r=40,rho=20", "ALM:r=20,rho=30"}) {
    const Solution solution = solved_by(method, system, with_tolerance(1e-12));
    ASSERT_EQ(solution.status, Status::ok) << method << ": " << solution.message;
    EXPECT_LT(force_error(solution, reference), 1e-8) << method;
  }
}

TEST(GridLagrangian, TooLargeAStepIsNotConvergedWithItsNumbers) {
  for (const Stop stop : {Stop::target, Stop::paper}) {
    RunControl control = with_tolerance(1e-8);
    control.stop = stop;
    const Solution solution = solved_by("ALM:r=20,rho=44", system_of(), control);
    EXPECT_EQ(solution.status, Status::not_converged);
    for (const char* part : {"r=20, rho=44", "i_C ", " N, relative residuals ", " iterations"})
      EXPECT_NE(solution.message.find(part), std::string::npos) << solution.message;
  }
}

TEST(GridLagrangian, SeveralStepsSideBySideAreEachAlone) {
  const AirySystem system = system_of();
  const AugmentedFactor augmented = factor_augmented(system, 20);
  UzawaOptions options;
  options.tolerance = 1e-6;
  options.max_iterations = 400;
  const std::vector<double> rhos = {44, 20, 1, 30, 25, 300};
  const std::vector<UzawaResult> together = iterate_uzawa(system, augmented, rhos, options, false);
  ASSERT_EQ(together.size(), rhos.size());
  std::set<UzawaOutcome> outcomes;
  for (std::size_t k = 0; k < rhos.size(); ++k) {
    SCOPED_TRACE(rhos[k]);
    const UzawaResult alone = iterate_uzawa(system, augmented, {rhos[k]}, options, false).front();
    EXPECT_EQ(together[k].rho, rhos[k]);
    EXPECT_EQ(together[k].iterations, alone.iterations);
    EXPECT_EQ(together[k].outcome, alone.outcome);
    EXPECT_EQ(together[k].history.size(), alone.history.size());
    if (alone.outcome == UzawaOutcome::converged) {
      EXPECT_LT(testing::distance(together[k].F_C, alone.F_C), 1e-9 * alone.F_C.norm());
    }
    outcomes.insert(alone.outcome);
  }
  EXPECT_EQ(outcomes.size(), 3u) << "one of each kind was meant";
}

TEST(GridLagrangian, TuningTriesTheWholeGridAndTakesTheFewestIterations) {
  const AirySystem system = system_of();
  for (const Stop stop : {Stop::target, Stop::paper}) {
    RunControl control = with_tolerance(1e-6);
    control.stop = stop;
    control.target_error = 1e-2;  // by its own estimate the error is above the tolerance
    const Tuning tuning = tune(system, control);
    std::set<std::pair<double, double>> points;
    const GridPoint* best = nullptr;
    for (const GridPoint& point : tuning.grid) {
      points.insert({point.r, point.rho});
      if (point.outcome == "converged" && (!best || point.iterations < best->iterations))
        best = &point;
    }
    EXPECT_EQ(tuning.grid.size(), 64u);
    EXPECT_EQ(points.size(), 64u);
    ASSERT_NE(best, nullptr);
    std::ostringstream chosen;
    chosen << "r=" << best->r << ", rho=" << best->rho;
    EXPECT_EQ(tuning.parameters, chosen.str());
    const Solution solution = run(tuning.solve, system, control);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_EQ(solution.uzawa_iterations, best->iterations);
    EXPECT_EQ(solution.parameters, tuning.parameters);
    // Giving up early has not cost a better one.
    for (const GridPoint& point : tuning.grid)
      if (point.outcome == "given up") {
        EXPECT_GE(point.iterations, best->iterations);
      }
  }
}

// The grid's parameters are best where its mean weights fit; here edges differ by a factor of 100.
TEST(AutomaticLagrangian, PenaltiesFollowGradedEdgesAndMaterials) {
  Scene scene;
  scene.mesh.grade = Grading{{10, 3}, 100};
  scene.material.young_MPa = 3;
  const AirySystem system = system_of(scene);
  const Solution solution = solved_by("ALM:AUTO", system), reference = solved_by("HYBRID", system);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LT(force_error(solution, reference), 1e-6);
  EXPECT_LE(solution.uzawa_iterations, 150);
}

TEST(AutomaticLagrangian, ItsOwnEstimateIsNotBelowItsError) {
  const AirySystem system = system_of();
  const Solution reference = solved_by("HYBRID", system);
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const RunControl control = with_tolerance(tolerance);
    const Solution solution = solved_by("ALM:AUTO", system, control);
    EXPECT_GT(solution.error_estimate.value(),
              testing::stress_error(*system.problem, solution, reference))
        << tolerance;
    EXPECT_EQ(solution.status,
              *solution.error_estimate <= control.target_error ? Status::ok : Status::inaccurate);
  }
}

TEST(AutomaticLagrangian, BelowRoundingItEndsAndTheCheckJudges) {
  const Solution solution = solved_by("ALM:AUTO", system_of(), with_tolerance(1e-16));
  EXPECT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LT(solution.uzawa_iterations, 1000);
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
}  // namespace airybench::augmented_lagrangian_test
