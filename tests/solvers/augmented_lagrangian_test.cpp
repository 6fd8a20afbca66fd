#include "solvers/uzawa/augmented_lagrangian.hpp"

#include <gtest/gtest.h>

#include <set>

#include "assembly/scene.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::augmented_lagrangian_test {
namespace {

using testing::named_scenes;
using testing::NamedScenes;
using testing::system_of;

Solution solve(const char* method, const DualSystem& system, const RunControl& control = {}) {
  return run(select_methods(method).front(), system, control);
}

Tuning tune(const DualSystem& system, const RunControl& control) {
  return select_methods("ALM").front().tune(system, control);
}

RunControl with(double tolerance, Stop stop = Stop::target) {
  RunControl control;
  control.tolerance = tolerance;
  control.stop = stop;
  return control;
}

double force_error(const Solution& solution, const Solution& reference) {
  return testing::distance(solution.F_C, reference.F_C) / reference.F_C.norm();
}

void expect_in_cone(const DualSystem& system, const Eigen::VectorXd& F_C) {
  const ContactPoints& contact = system.contact;
  for (int p = 0; p < contact.count; ++p) {
    const double normal = F_C(contact.components * p);
    EXPECT_LE(normal, 0);
    if (contact.components == 2) {
      EXPECT_LE(std::abs(F_C(2 * p + 1)), -contact.friction_at(p) * normal * (1 + 1e-15));
    }
  }
}

NamedScenes scenes() {
  return named_scenes({
      {"default", [](Scene&) {}},
      {"frictionless", [](Scene& s) { s.friction = 0; }},
      {"body force",
       [](Scene& s) {
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"frictionless, body force",
       [](Scene& s) {
         s.friction = 0;
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"clearance", [](Scene& s) { s.clearance_mm = 0.005; }},
      {"high friction", [](Scene& s) { s.friction = 2; }},
  });
}

TEST(AugmentedLagrangian, ConvergesToTheReferenceOnEveryScene) {
  for (const auto& [name, scene] : scenes()) {
    const DualSystem system = system_of(scene);
    const Solution reference = solve("HYBRID", system);
    const Solution solution = solve("ALM:r=20,rho=20", system, with(1e-12));
    ASSERT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    EXPECT_LT(force_error(solution, reference), 1e-9) << name;
    EXPECT_LT(stress_distance(*system.problem, solution.stress, reference.stress), 1e-7) << name;
    EXPECT_EQ(solution.parameters, "r=20, rho=20");
    EXPECT_GT(solution.uzawa_iterations.value(), 1);
    expect_in_cone(system, solution.F_C);
  }
}

TEST(AugmentedLagrangian, AnyParametersThatConvergeHaveTheSameLimit) {
  const DualSystem system = system_of();
  const Solution reference = solve("HYBRID", system);
  for (const char* method :
       {"ALM:r=5,rho=5", "ALM:r=60,rho=60", "ALM:r=40,rho=20", "ALM:r=20,rho=30"}) {
    const Solution solution = solve(method, system, with(1e-12));
    ASSERT_EQ(solution.status, Status::ok) << method << ": " << solution.message;
    EXPECT_LT(force_error(solution, reference), 1e-8) << method;
  }
}

TEST(AugmentedLagrangian, ATighterToleranceIsASmallerErrorAndMoreIterations) {
  const DualSystem system = system_of();
  const Solution reference = solve("HYBRID", system);
  const Solution coarse = solve("ALM:r=20,rho=20", system, with(1e-3));
  const Solution medium = solve("ALM:r=20,rho=20", system, with(1e-6));
  const Solution fine = solve("ALM:r=20,rho=20", system, with(1e-9));
  EXPECT_LT(force_error(fine, reference), force_error(medium, reference));
  EXPECT_LT(force_error(medium, reference), force_error(coarse, reference));
  EXPECT_LT(*coarse.uzawa_iterations, *medium.uzawa_iterations);
  EXPECT_LT(*medium.uzawa_iterations, *fine.uzawa_iterations);
}

TEST(AugmentedLagrangian, TooLargeAStepIsNotConvergedWithItsNumbers) {
  for (const Stop stop : {Stop::target, Stop::paper}) {
    const Solution solution = solve("ALM:r=20,rho=44", system_of(), with(1e-8, stop));
    EXPECT_EQ(solution.status, Status::not_converged);
    for (const char* part : {"r=20, rho=44", "i_C ", " N, relative residuals ", " iterations"})
      EXPECT_NE(solution.message.find(part), std::string::npos) << solution.message;
  }
}

TEST(AugmentedLagrangian, ThePapersStopIsFeasibilityOnlyAndLeavesALargerError) {
  const DualSystem system = system_of();
  const Solution reference = solve("HYBRID", system);
  RunControl control = with(1e-8, Stop::paper);
  control.histories = true;
  const Solution paper = solve("ALM:r=20,rho=20", system, control);
  ASSERT_EQ(paper.status, Status::ok) << paper.message;
  const std::vector<double>& history = paper.histories.front().residual;
  EXPECT_EQ(history.size(), static_cast<std::size_t>(*paper.uzawa_iterations));
  EXPECT_LE(history.back(), UzawaOptions::paper_stop_N);
  for (std::size_t k = 0; k + 1 < history.size(); ++k)
    EXPECT_GT(history[k], UzawaOptions::paper_stop_N);
  const Solution target = solve("ALM:r=20,rho=20", system, with(1e-8));
  EXPECT_GT(force_error(paper, reference), 10 * force_error(target, reference));
}

TEST(AugmentedLagrangian, SeveralStepsSideBySideAreEachAlone) {
  const DualSystem system = system_of();
  const AugmentedFactor augmented = factor_augmented(system, 20);
  UzawaOptions options;
  options.tolerance = 1e-6;
  options.most_iterations = 400;
  const std::vector<double> rhos = {44, 20, 1, 30, 25, 300};
  const std::vector<UzawaResult> together = iterate_uzawa(system, augmented, rhos, options, false);
  ASSERT_EQ(together.size(), rhos.size());
  std::set<UzawaOutcome> outcomes;
  for (std::size_t k = 0; k < rhos.size(); ++k) {
    const UzawaResult alone = iterate_uzawa(system, augmented, {rhos[k]}, options, false).front();
    EXPECT_EQ(together[k].rho, rhos[k]);
    EXPECT_EQ(together[k].iterations, alone.iterations) << rhos[k];
    EXPECT_EQ(together[k].outcome, alone.outcome) << rhos[k];
    EXPECT_EQ(together[k].history.size(), alone.history.size());
    if (alone.outcome == UzawaOutcome::converged) {
      EXPECT_LT(testing::distance(together[k].F_C, alone.F_C), 1e-9 * alone.F_C.norm()) << rhos[k];
    }
    outcomes.insert(alone.outcome);
  }
  EXPECT_EQ(outcomes.size(), 3u) << "one of each kind was meant";
}

TEST(AugmentedLagrangian, ThePenalisedMatrixHasThePatternOfS) {
  const DualSystem system = system_of();
  const AugmentedFactor augmented = factor_augmented(system, 20);
  EXPECT_EQ(augmented.factor.profile.profile, analyse_skyline(system.S).profile);
  EXPECT_GT(augmented.factor.diagonal.minCoeff(), 0);
}

TEST(AugmentedLagrangian, TuningTriesTheWholeGridAndTakesTheFewestIterations) {
  const DualSystem system = system_of();
  for (const Stop stop : {Stop::target, Stop::paper}) {
    RunControl control = with(1e-6, stop);
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

TEST(AugmentedLagrangian, WhatIsNotFiniteNeitherConvergesNorIsChosen) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    DualSystem system = system_of();
    system.q = Eigen::VectorXd::Constant(system.n(), poison);
    EXPECT_THROW(tune(system, with(1e-6)), Breakdown);
    EXPECT_EQ(solve("ALM:r=20,rho=20", system).status, Status::not_converged);
    system = system_of();
    system.S.valuePtr()[5] = poison;
    EXPECT_EQ(solve("ALM:r=20,rho=20", system).status, Status::breakdown);
  }
}

TEST(AugmentedLagrangian, WithoutContactItSolvesTheEqualities) {
  Mesh mesh = testing::small_tooth(6, 5);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) edge.role = BoundaryRole::force;
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.body_force_N_per_mm3 = {3, -1};
  const DualSystem system = system_of(scene, mesh);
  const Solution reference = solve("HYBRID", system);
  const Solution solution = solve("ALM:r=20,rho=20", system, with(1e-12));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_EQ(solution.F_C.size(), 0);
  EXPECT_LT(stress_distance(*system.problem, solution.stress, reference.stress), 1e-7);
}

TEST(AugmentedLagrangian, WithoutLoadThereIsNothingToDo) {
  Scene scene;
  scene.displacement_mm.setZero();
  const Solution solution = solve("ALM:r=20,rho=20", system_of(scene));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_TRUE(solution.F_C.isZero(0));
  EXPECT_TRUE(solution.phi.isZero(0));
  EXPECT_EQ(solution.uzawa_iterations, 1);
}

TEST(AugmentedLagrangian, OutOfTimeIsATimeoutOfTuningToo) {
  RunControl control;
  control.deadline = Deadline::after(-1);
  EXPECT_EQ(solve("ALM:r=20,rho=20", system_of(), control).status, Status::timeout);
  EXPECT_EQ(solve("ALM", system_of(), control).status, Status::timeout);
}

}  // namespace
}  // namespace airybench::augmented_lagrangian_test
