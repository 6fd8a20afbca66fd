// HYBRID:PDAS, active sets on K itself, against HYBRID, which forms D.
#include "solvers/active_sets/active_set_solve.hpp"

#include <gtest/gtest.h>

#include "assembly/elements/equilibrium_element.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/random_scenes.hpp"
#include "tests/support/solved.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::factored_rows_test {
namespace {

using testing::posed;

std::string pdas_of_degree(int degree) { return "HYBRID:PDAS,k=" + std::to_string(degree); }

struct Named {
  std::string name;
  std::shared_ptr<const Problem> problem;
};

std::vector<Named> problems() {
  std::vector<Named> all;
  for (const auto& [name, scene] : testing::scenes_named(
           {"default", "frictionless", "friction 1", "friction 3, sheared", "plane stress",
            "body force", "flat face", "clearance", "nearly incompressible", "nothing touches"}))
    for (const Mesh& mesh : {testing::small_tooth(8, 6), testing::small_rack(2, 4, 3)})
      all.push_back({mesh.name + ", " + name, posed(scene, mesh)});
  for (const double friction : {0., 0.3, 1.})
    for (const auto& [lower, upper] : {std::pair(8, 8), {7, 10}})
      all.push_back(
          {"blocks", posed(testing::pressed(friction), testing::two_blocks(lower, upper))});
  return all;
}

TEST(FactoredRows, HaveTheAnswerOfTheCondensedProblem) {
  for (const auto& [name, problem] : problems())
    for (int degree = 1; degree <= highest_stress_degree; ++degree) {
      SCOPED_TRACE(name + ", k = " + std::to_string(degree));
      const ContactSystem system = contact_system(problem, degree);
      const Solution all = testing::solved_by(hybrid_of_degree(degree), system),
                     found = testing::solved_by(pdas_of_degree(degree), system);
      ASSERT_EQ(all.status, Status::ok) << all.message;
      ASSERT_EQ(found.status, Status::ok) << found.message;
      EXPECT_LE(testing::distance(found.F_C, all.F_C), 1e-9 * all.F_C.norm());
      EXPECT_LE(testing::distance(found.contact_displacement, all.contact_displacement),
                1e-9 * all.contact_displacement.norm());
      EXPECT_LE(stress_distance(*problem, found.stress, all.stress),
                1e-9 * std::sqrt(stress_norm_squared(*problem, all.stress)));
    }
}

// From the forces of the answer, by which few points are on the edge of a law, few sets follow.
TEST(FactoredRows, BeginWithTheLawsOfGivenForces) {
  int with_start = 0, without = 0;
  for (const auto& [name, problem] : problems()) {
    SCOPED_TRACE(name);
    const ContactSystem system = contact_system(problem);
    RunControl control;
    const Solution alone = testing::solved_by("HYBRID:PDAS", system, control);
    control.contact.start = testing::solved_by("HYBRID", system).F_C;
    const Solution found = testing::solved_by("HYBRID:PDAS", system, control);
    ASSERT_EQ(found.status, Status::ok) << found.message;
    EXPECT_LE(*found.newton_steps, 3);
    with_start += *found.newton_steps;
    without += *alone.newton_steps;
  }
  EXPECT_LT(2 * with_start, without);
}

TEST(FactoredRows, RandomScenesAreSolvedOrItSaysThatTheyAreNot) {
  constexpr int scenes_tried = 60;
  const Mesh mesh = testing::small_tooth(8, 6);
  int posed_scenes = 0, solved = 0;
  for (int number = 0; number < scenes_tried; ++number) {
    std::shared_ptr<const Problem> problem;
    try {
      problem = posed(testing::random_scene(19, number), mesh);
    } catch (const InputError&) {
      continue;
    }
    const ContactSystem system = contact_system(problem);
    const Solution exact = testing::solved_by("HYBRID", system);
    if (exact.status != Status::ok) continue;
    ++posed_scenes;
    const Solution found = testing::solved_by("HYBRID:PDAS", system);
    if (found.status != Status::ok) continue;
    ++solved;
    if (exact.F_C.norm() < 1e-6) continue;  // relative to the loads
    EXPECT_LE(testing::force_error(found, exact), 1e-5) << number;
  }
  ASSERT_GT(posed_scenes, scenes_tried / 2);
  EXPECT_GE(solved, posed_scenes * 9 / 10) << posed_scenes;
}

// So many that D is not formed at first: there is no stage of condensing.
TEST(FactoredRows, AreWhatHybridTakesForManyContactPoints) {
  constexpr int degree = 3;
  const ContactSystem system = contact_system(testing::pressed_plate(400), degree);
  ASSERT_TRUE(active_sets_cost_less_than_D(system));
  const Solution found = testing::solved_by(hybrid_of_degree(degree), system);
  ASSERT_EQ(found.status, Status::ok) << found.message;
  EXPECT_FALSE(found.times[Stage::condense]);
  const Solution by_D = testing::solved_by("HYBRID:CHOLMOD,k=3", system);
  EXPECT_LT(testing::force_error(found, by_D), 1e-9);
}

// Friction remembers; two bodies that are rubbed to and fro.
TEST(FactoredRows, FollowAPathOfTwoBodies) {
  Scene scene = testing::pressed(0.3, {0, -0.01});
  for (const double x : {0.008, -0.008, 0.008}) {
    LoadStep step;
    step.boundary["displacement:head"].displacement_mm =
        LinearValue<Eigen::Vector2d>{{Eigen::Vector2d(x, -0.01), Eigen::Vector2d(x, -0.01)}};
    scene.later_steps.push_back(step);
  }
  const auto problem = posed(scene, testing::two_blocks(7, 10));
  const auto last = [&](const char* name) {
    return solve_load_steps(select_methods(name).front(), problem, {});
  };
  const Solution by_D = last("HYBRID"), found = last("HYBRID:PDAS");
  ASSERT_EQ(found.status, Status::ok) << found.message;
  EXPECT_LT(testing::force_error(found, by_D), 1e-8);
}

}  // namespace
}  // namespace airybench::factored_rows_test
