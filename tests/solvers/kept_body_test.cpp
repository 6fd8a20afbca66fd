// A body that is condensed once: other load cases have the answers of solves of their own.
#include "solvers/base/kept_body.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"

namespace airybench::kept_body_test {

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace {

using testing::named_scenes;
using testing::NamedScenes;
using testing::posed;

NamedScenes load_cases() {
  return named_scenes({
      {"another displacement",
       [](Scene& s) {
         s.displacement_mm = {0.03, -0.01};
       }},
      {"body force",
       [](Scene& s) {
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"clearance", [](Scene& s) { s.clearance_mm = 0.005; }},
      {"flat wall", [](Scene& s) { s.crown_radius_mm.reset(); }},
      {"more friction", [](Scene& s) { s.friction = 0.7; }},
      {"the first again", [](Scene&) {}},
  });
}

class KeptBody : public ::testing::TestWithParam<Method> {
 protected:
  static RunControl keeping() {
    RunControl control;
    control.keep_body = true;
    return control;
  }
};

std::vector<Method> keeping_methods() {
  return select_methods(
      "HYBRID,HYBRID:CHOLMOD,HYBRID:MUMPS,P2,3STEPD,3STEPD:REFINED,3STEPD:FILE,3STEPD:LEAN,3STEPD:"
      "CHOLMOD,BLIND,BLIND:SKY,"
      "BLIND:SCHUR,BLIND:SCHUR:REFINED");
}
INSTANTIATE_TEST_SUITE_P(Table, KeptBody, ::testing::ValuesIn(keeping_methods()),
                         testing::readable);

TEST_P(KeptBody, SolvesOtherLoadCasesAsIfTheyWereAlone) {
  DualSystem system = assemble(posed({}), GetParam().blocks);
  const Solution first = run(GetParam(), system, keeping());
  ASSERT_EQ(first.status, Status::ok) << first.message;
  ASSERT_TRUE(first.solve_again);
  for (const auto& [name, scene] : load_cases()) {
    const auto problem = posed(scene);
    set_load_case(system, problem);
    const Solution again = run(first.solve_again, system, {});
    const Solution alone = run(GetParam(), assemble(problem, GetParam().blocks), {});
    ASSERT_EQ(again.status, Status::ok) << name << ": " << again.message;
    EXPECT_LT(testing::distance(again.F_C, alone.F_C), 1e-10 * alone.F_C.norm()) << name;
    EXPECT_LT(stress_distance(*problem, again.stress, alone.stress), 1e-9) << name;
    EXPECT_LT(again.error_estimate.value(), 1e-8) << name;
    for (const Stage stage : {Stage::order, Stage::factor, Stage::condense})
      EXPECT_FALSE(again.times[stage]) << name << ": " << name_of(stage);
  }
}

TEST_P(KeptBody, WithoutFrictionToo) {
  Scene scene;
  scene.friction = 0;
  DualSystem system = assemble(posed(scene), GetParam().blocks);
  const Solution first = run(GetParam(), system, keeping());
  scene.displacement_mm = {0.01, 0};
  set_load_case(system, posed(scene));
  const Solution again = run(first.solve_again, system, {});
  const Solution alone = run(GetParam(), assemble(posed(scene), GetParam().blocks), {});
  EXPECT_LT(testing::distance(again.F_C, alone.F_C), 1e-10 * alone.F_C.norm());
}

TEST_P(KeptBody, IsKeptOnRequestOnlyAndChangesNothing) {
  const DualSystem system = assemble(posed({}), GetParam().blocks);
  const Solution kept = run(GetParam(), system, keeping()), plain = run(GetParam(), system, {});
  EXPECT_FALSE(plain.solve_again);
  EXPECT_EQ(kept.F_C, plain.F_C);
  EXPECT_EQ(kept.stress, plain.stress);
}

TEST_P(KeptBody, RefusesAnotherBody) {
  const Solution first = run(GetParam(), assemble(posed({}), GetParam().blocks), keeping());
  Scene frictionless, softer;
  frictionless.friction = 0;
  softer.material.young_MPa /= 2;
  for (const auto& problem :
       {posed({}, testing::small_tooth(7, 5)), posed(frictionless), posed(softer)}) {
    const Solution refused = run(first.solve_again, assemble(problem, GetParam().blocks), {});
    EXPECT_EQ(refused.status, Status::crashed);
    EXPECT_NE(refused.message.find("of another body"), std::string::npos) << refused.message;
  }
}

// Its factor is kept; the iterations are every load case's own.
TEST(KeptBodies, OfTheAugmentedLagrangianAreItsFactor) {
  DualSystem system = assemble(posed({}));
  RunControl control;
  control.keep_body = true;
  const Solution first = run(select_methods("ALM:AUTO").front(), system, control);
  for (const auto& [name, scene] : load_cases()) {
    set_load_case(system, posed(scene));
    const Solution again = run(first.solve_again, system, {});
    const Solution exact = run(select_methods("HYBRID").front(), system, {});
    ASSERT_EQ(again.status, Status::ok) << name << ": " << again.message;
    EXPECT_LT(testing::distance(again.F_C, exact.F_C), 1e-6 * exact.F_C.norm()) << name;
    EXPECT_FALSE(again.times[Stage::factor]) << name;
  }
}

// Both levels are kept.
TEST(KeptBodies, OfHybridCgAreItsPreconditioner) {
  for (const double friction : {0.2, 0.0}) {
    Scene first_scene;
    first_scene.friction = friction;
    DualSystem system = assemble(posed(first_scene), Blocks::contact_points);
    RunControl control;
    control.keep_body = true;
    const Method method = select_methods("HYBRID:CG").front();
    const Solution first = run(method, system, control);
    ASSERT_EQ(first.status, Status::ok) << first.message;
    ASSERT_TRUE(first.solve_again);
    EXPECT_EQ(first.F_C, run(method, system, {}).F_C);
    for (const auto& [name, scene] : load_cases()) {
      Scene other = scene;
      if (friction == 0) other.friction = 0;
      set_load_case(system, posed(other));
      const Solution again = run(first.solve_again, system, {}), alone = run(method, system, {}),
                     exact = run(select_methods("HYBRID").front(), system, {});
      ASSERT_EQ(again.status, Status::ok) << name << ": " << again.message;
      EXPECT_LT(testing::distance(again.F_C, exact.F_C), 1e-7 * exact.F_C.norm()) << name;
      EXPECT_LT(stress_distance(*system.problem, again.stress, exact.stress), 1e-6) << name;
      EXPECT_EQ(again.linear_iterations, alone.linear_iterations) << name;
      for (const Stage stage : {Stage::precondition, Stage::order, Stage::factor})
        EXPECT_FALSE(again.times[stage]) << name << ": " << name_of(stage);
    }
  }
}

TEST(KeptBodies, AreNotThoseOfIterations) {
  const DualSystem system = assemble(posed({}));
  RunControl control;
  control.keep_body = true;
  for (const char* method : {"SYMMLQ:SKY", "3STEPCG:SKY"})
    EXPECT_FALSE(run(select_methods(method).front(), system, control).solve_again) << method;
}

}  // namespace
}  // namespace airybench::kept_body_test
