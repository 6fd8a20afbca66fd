// Paths of loads whose answers are known.
#include "solvers/loading/load_steps.hpp"

#include <gtest/gtest.h>

#include "assembly/problem/pose.hpp"
#include "solvers/base/kept_body.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::load_steps_test {
namespace {

// The tooth moved to these places one after another; μ = 0.2 if nothing else is said.
std::shared_ptr<const Problem> path(const std::vector<Eigen::Vector2d>& places, Scene scene = {},
                                    const Mesh& mesh = testing::small_tooth(6, 5)) {
  const auto at = [&](const Eigen::Vector2d& place) {
    scene.displacement_mm = place;
    return pose(scene, mesh);
  };
  auto problem = std::make_shared<Problem>(at(places.front()));
  const auto all_of_u0 = [&](const Eigen::Vector2d& place) {
    Loads loads = at(place).loads;
    loads.displacement_mm = [place](const Eigen::Vector2d&, int) { return place; };
    return loads;
  };
  for (std::size_t k = 1; k < places.size(); ++k)
    problem->later_steps.push_back(all_of_u0(places[k]));
  return problem;
}

double tangential_resultant(const Solution& solution) {
  double sum = 0;
  for (Eigen::Index p = 1; p < solution.F_C.size(); p += 2) sum += solution.F_C(p);
  return sum;
}
double normal_resultant(const Solution& solution) {
  double sum = 0;
  for (Eigen::Index p = 0; p < solution.F_C.size(); p += 2) sum += solution.F_C(p);
  return sum;
}

class LoadSteps : public ::testing::TestWithParam<Method> {
 protected:
  static RunControl control() {
    RunControl tight;
    tight.tolerance = 1e-11;
    return tight;
  }
  static Solution at_the_end(const std::vector<Eigen::Vector2d>& places, const Scene& scene = {}) {
    Solution last = solve_load_steps(GetParam(), path(places, scene), control());
    EXPECT_EQ(last.status, Status::ok) << last.message;
    return last;
  }
  static double apart(const Solution& a, const Solution& b) {
    return testing::distance(a.F_C, b.F_C) / b.F_C.norm();
  }
};
INSTANTIATE_TEST_SUITE_P(
    Methods, LoadSteps,
    ::testing::ValuesIn(select_methods(testing::hybrid_of_every_degree() +
                                       ",HYBRID:CG,P2,P3,P4,3STEPD:CHOLMOD,3STEPD:REFINED,"
                                       "BLIND:SCHUR,ALM:AUTO,SSKY")),
    testing::readable);

TEST_P(LoadSteps, TheFirstIsTheSingleSolve) {
  const auto problem = path({{0.02, 0.006}, {0.02, 0}});
  const Solution alone = run(GetParam(), *assemble(GetParam(), problem), control());
  int steps = 0;
  solve_load_steps(GetParam(), problem, control(),
                   [&](int step, const ContactSystem&, const Solution& answer) {
                     EXPECT_EQ(step, steps++);
                     if (step > 0) return;
                     EXPECT_EQ(answer.F_C, alone.F_C);
                     EXPECT_EQ(answer.stress, alone.stress);
                   });
  EXPECT_EQ(steps, 2);
}

TEST_P(LoadSteps, StayingChangesNothing) {
  const Solution there = at_the_end({{0.02, 0.006}}),
                 stayed = at_the_end({{0.02, 0.006}, {0.02, 0.006}});
  EXPECT_LT(apart(stayed, there), 1e-7);
}

// Without a gap all grows in proportion, and slip never turns.
TEST_P(LoadSteps, InProportionOneStepAndManyAreTheSame) {
  Scene flat;
  flat.crown_radius_mm.reset();
  std::vector<Eigen::Vector2d> places;
  for (const double part : {0.1, 0.25, 0.5, 0.8, 1.})
    places.emplace_back(part * 0.02, part * 0.006);
  EXPECT_LT(apart(at_the_end(places, flat), at_the_end({places.back()}, flat)), 1e-7);
}

// Pressed, sheared and brought back: tangential forces stay behind, towards where it was.
TEST_P(LoadSteps, UnloadingLeavesTangentialForcesBehind) {
  const Solution never = at_the_end({{0.02, 0}}), sheared = at_the_end({{0.02, 0}, {0.02, 0.006}}),
                 back = at_the_end({{0.02, 0}, {0.02, 0.006}, {0.02, 0}});
  EXPECT_LT(tangential_resultant(sheared), 0);
  EXPECT_GT(tangential_resultant(back) - tangential_resultant(never),
            0.01 * std::abs(tangential_resultant(sheared)));
  EXPECT_NEAR(normal_resultant(back), normal_resultant(never),
              0.05 * std::abs(normal_resultant(never)));
}

// Dragged far, all of it slips: ΣF_t = ∓μ ΣF_n. Back by a hair, and it sticks with the forces that
// it has, which no single solve knows; back far, and it slips the other way.
TEST_P(LoadSteps, DraggedToAndFroItGoesThroughTheHysteresisLoop) {
  constexpr double mu = 0.2, pressed = 0.02, far = 1;
  const std::vector<Eigen::Vector2d> places = {
      {pressed, far}, {pressed, far - 1e-9}, {pressed, -far}, {pressed, far}};
  std::vector<Solution> at;
  solve_load_steps(
      GetParam(), path(places), control(),
      [&](int, const ContactSystem&, const Solution& answer) { at.push_back(answer); });
  ASSERT_EQ(at.size(), places.size());
  const auto ratio = [](const Solution& s) {
    return tangential_resultant(s) / normal_resultant(s);
  };
  EXPECT_NEAR(ratio(at[0]), mu, 1e-9);
  EXPECT_NEAR(ratio(at[1]), mu, 1e-5);
  EXPECT_LT(ratio(at[1]), mu);
  EXPECT_NEAR(ratio(at[2]), -mu, 1e-9);
  EXPECT_NEAR(ratio(at[3]), mu, 1e-9);
  EXPECT_LT(apart(at[3], at[0]), 1e-7);  // the loop is closed
}

// Equal steps in halves are twice as many; of a list the middle is the mean.
TEST(LoadStepsOfHybrid, InHalvesTheyAreTwiceAsMany) {
  Scene scene;
  scene.body_force_N_per_mm3 = {0.3, -0.7};
  const auto ends = [&](int equal_steps) {
    scene.equal_steps = equal_steps;
    return std::make_shared<const Problem>(pose(scene, testing::small_tooth(6, 5)));
  };
  const Method method = select_methods("HYBRID").front();
  const auto forces = [&](const std::shared_ptr<const Problem>& first) {
    std::vector<Eigen::VectorXd> all;
    solve_load_steps(method, first, {}, [&](int, const ContactSystem&, const Solution& answer) {
      all.push_back(answer.F_C);
    });
    return all;
  };
  const auto expect_same = [&](const std::vector<Eigen::VectorXd>& found,
                               const std::vector<Eigen::VectorXd>& right) {
    ASSERT_EQ(found.size(), right.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LE(testing::distance(found[k], right[k]), 1e-10 * right[k].norm()) << k;
  };
  const auto halves_of = [](const std::shared_ptr<const Problem>& first) {
    return std::make_shared<const Problem>(with_half_steps(*first));
  };
  for (const int steps : {1, 3})
    expect_same(forces(halves_of(ends(steps))), forces(ends(2 * steps)));
  expect_same(
      forces(halves_of(path({{0.02, 0}, {0.03, 0.006}, {0.01, -0.01}}))),
      forces(path(
          {{0.01, 0}, {0.02, 0}, {0.025, 0.003}, {0.03, 0.006}, {0.02, -0.002}, {0.01, -0.01}})));
}

TEST(LoadStepsOfHybrid, InHalvesTractionsAndGapsAreMeansToo) {
  struct Loaded {
    double pressure_MPa, clearance_mm, x_mm;
  };
  const auto scene_of = [](const std::vector<Loaded>& steps) {
    Scene scene;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const auto& [pressure_MPa, clearance_mm, x_mm] = steps[k];
      LoadStep step;
      step.displacement_mm = Eigen::Vector2d(x_mm, 0.3 * x_mm);
      step.clearance_mm = clearance_mm;
      step.boundary["force"].pressure_MPa = LinearValue<double>{{pressure_MPa, pressure_MPa}};
      if (k > 0) {
        scene.later_steps.push_back(step);
        continue;
      }
      scene.displacement_mm = *step.displacement_mm;
      scene.clearance_mm = *step.clearance_mm;
      scene.boundary = step.boundary;
    }
    return std::make_shared<const Problem>(pose(scene, testing::small_tooth(6, 5)));
  };
  const auto path = scene_of({{2, 0.004, 0.02}, {6, 0, 0.03}}),
             halves =
                 scene_of({{1, 0.004, 0.01}, {2, 0.004, 0.02}, {4, 0.002, 0.025}, {6, 0, 0.03}});
  const Method method = select_methods("HYBRID").front();
  const Solution found = solve_load_steps(
                     method, std::make_shared<const Problem>(with_half_steps(*path)), {}),
                 right = solve_load_steps(method, halves, {});
  EXPECT_LE(testing::distance(found.F_C, right.F_C), 1e-10 * right.F_C.norm());
  EXPECT_GT(testing::distance(found.F_C, solve_load_steps(method, path, {}).F_C),
            1e-6 * right.F_C.norm());
}

TEST(LoadStepsOfHybrid, BeginWithTheForcesOfTheStepBefore) {
  std::vector<Eigen::Vector2d> places;
  for (int k = 0; k <= 20; ++k) places.emplace_back(0.02, 0.02 * std::sin(0.3 * k));
  const Method method = select_methods("HYBRID").front();
  int warm = 0, cold = 0;
  solve_load_steps(method, path(places, {}, testing::small_tooth(24, 20)), {},
                   [&](int, const ContactSystem& system, const Solution& answer) {
                     const Solution alone = run(method, system, {});
                     EXPECT_LT(testing::distance(answer.F_C, alone.F_C), 1e-9 * alone.F_C.norm());
                     warm += answer.newton_steps.value();
                     cold += alone.newton_steps.value();
                   });
  RecordProperty("warm", warm);
  RecordProperty("cold", cold);
  EXPECT_LT(warm, 0.9 * cold);
}

// Slip is what the body has done, not what it was told: lifted off and put down, it forgets.
TEST_P(LoadSteps, LiftedOffItForgets) {
  const Solution anew = at_the_end({{0.02, 0.006}}),
                 again = at_the_end({{0.02, -0.01}, {-0.02, 0}, {0.02, 0.006}});
  // From where it hung freely, at (-0.02, 0), as from rest.
  EXPECT_LT(apart(again, anew), 1e-7);
}

// Tractions, body force and gap may go along the path, too.
TEST_P(LoadSteps, AnyLoadMayChange) {
  Scene scene;
  const auto problem = std::make_shared<Problem>(pose(scene, testing::small_tooth(6, 5)));
  scene.body_force_N_per_mm3 = {3, -1};
  scene.clearance_mm = 0.002;
  Loads next = pose(scene, testing::small_tooth(6, 5)).loads;
  next.displacement_mm = [](const Eigen::Vector2d&, int) { return Eigen::Vector2d(0.02, 0.006); };
  problem->later_steps = {next};
  const Solution answer = solve_load_steps(GetParam(), problem, control());
  ASSERT_EQ(answer.status, Status::ok) << answer.message;
  const Solution other = solve_load_steps(select_methods("HYBRID").front(), problem, {});
  EXPECT_NEAR(normal_resultant(answer), normal_resultant(other),
              0.05 * std::abs(normal_resultant(other)));
  if (!GetParam().in_displacements() && GetParam().degree == 1) {
    EXPECT_LT(apart(answer, other), 1e-6);
  }
}

// What the next step takes for s has the moments of this step's slip, all k + 1 of an edge.
TEST(LoadStepsOf, StressesOfEveryDegreeTheSlipIsKnownByAllItsMoments) {
  for (int k = 1; k <= highest_stress_degree; ++k) {
    const auto problem = path({{0.02, 0.006}});
    const ContactSystem system = contact_system(problem, k);
    const Solution answer = run(select_methods(hybrid_of_degree(k)).front(), system, {});
    const Eigen::VectorXd slip = relative_to_gap(system.contact, answer.contact_displacement);
    Loads next = path({{0.02, 0.006}})->loads;
    next.displacement_mm = [](const Eigen::Vector2d&, int) { return Eigen::Vector2d(0.02, 0.006); };
    next.slid_mm = slid_after(system, answer);
    EXPECT_EQ(next.slid_mm.rows(), k + 1);
    const Eigen::VectorXd moved =
        contact_points(with_loads(*problem, next), k).gap - system.contact.gap;
    for (int p = 0; p < system.contact.count; ++p) {
      EXPECT_NEAR(moved(2 * p + 1), slip(2 * p + 1), 1e-13 * slip.lpNorm<Eigen::Infinity>()) << k;
      EXPECT_EQ(moved(2 * p), 0);
    }
  }
}

TEST(LoadStepsOf, ASlipOfAHigherDegreeIsRefused) {
  const auto problem = path({{0.02, 0.006}});
  Loads loads = problem->loads;
  loads.slid_mm = Eigen::MatrixXd::Zero(5, std::ssize(problem->mesh.boundary));
  EXPECT_THROW(contact_points(with_loads(*problem, loads), 1), std::invalid_argument);
}

TEST(LoadStepsOf, AMethodThatFailsEndsThePath) {
  int steps = 0;
  RunControl control;
  control.max_iterations = 2;
  const Solution last =
      solve_load_steps(select_methods("ALM:r=20,rho=44").front(), path({{0.02, 0}, {0.02, 0.006}}),
                       control, [&](int, const ContactSystem&, const Solution&) { ++steps; });
  EXPECT_EQ(last.status, Status::not_converged);
  EXPECT_GE(steps, 1);
}

TEST(LoadStepsOf, WithoutFrictionThereIsNoMemory) {
  Scene scene;
  scene.friction = 0;
  const Method hybrid = select_methods("HYBRID").front();
  const Solution there = solve_load_steps(hybrid, path({{0.02, 0.006}, {0.02, 0}}, scene), {}),
                 alone = solve_load_steps(hybrid, path({{0.02, 0}}, scene), {});
  EXPECT_LT(testing::distance(there.F_C, alone.F_C), 1e-9 * alone.F_C.norm());
}

}  // namespace
}  // namespace airybench::load_steps_test
