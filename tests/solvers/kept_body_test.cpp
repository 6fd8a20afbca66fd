// A body that is condensed once: other load cases have the answers of solves of their own.
#include "solvers/base/kept_body.hpp"

#include <gtest/gtest.h>

#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"

namespace airybench::kept_body_test {
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

RunControl keeping() {
  RunControl control;
  control.keep_body = true;
  return control;
}

class KeptBody : public ::testing::TestWithParam<Method> {
 protected:
  static std::unique_ptr<ContactSystem> assembled(const Scene& scene = {}) {
    return assemble(GetParam(), posed(scene));
  }
};
INSTANTIATE_TEST_SUITE_P(
    Table, KeptBody,
    ::testing::ValuesIn(select_methods(
        "HYBRID,HYBRID:CHOLMOD,HYBRID:MUMPS,HYBRID:PDAS,HYBRID:CG,P2,P4,3STEPD,3STEPD:REFINED,"
        "3STEPD:FILE,3STEPD:LEAN,3STEPD:CHOLMOD,BLIND,BLIND:SKY,BLIND:SCHUR,BLIND:"
        "SCHUR:REFINED,ALM:AUTO")),
    testing::readable);

// ALM:AUTO keeps its factor, HYBRID:CG both levels: the iterations are every load case's own.
TEST_P(KeptBody, SolvesOtherLoadCasesAsIfTheyWereAlone) {
  const double max_off = GetParam().is_iterative() ? 1e-6 : 1e-9;
  for (const bool has_friction : {true, false}) {
    const auto with_friction = [&](Scene scene) {
      if (!has_friction) scene.friction = 0;
      return scene;
    };
    const std::unique_ptr<ContactSystem> system = assembled(with_friction({}));
    const Solution first = run(GetParam(), *system, keeping());
    ASSERT_EQ(first.status, Status::ok) << first.message;
    ASSERT_TRUE(first.solve_again);
    for (const auto& [name, scene] : load_cases()) {
      system->set_load_case(posed(with_friction(scene)));
      const Solution again = run(first.solve_again, *system, {});
      const Solution alone = run(GetParam(), *assembled(with_friction(scene)), {});
      ASSERT_EQ(again.status, Status::ok) << name << ": " << again.message;
      EXPECT_LT(testing::distance(again.F_C, alone.F_C), max_off / 10 * alone.F_C.norm()) << name;
      EXPECT_LT(stress_distance(*system->problem, again.stress, alone.stress), max_off) << name;
      EXPECT_LT(again.error_estimate.value(), 10 * max_off) << name;
      EXPECT_EQ(again.linear_iterations, alone.linear_iterations) << name;
      for (const Stage stage : {Stage::precondition, Stage::order, Stage::factor, Stage::condense})
        EXPECT_FALSE(again.times[stage]) << name << ": " << name_of(stage);
    }
  }
}

TEST_P(KeptBody, IsKeptOnRequestOnlyAndChangesNothing) {
  const std::unique_ptr<ContactSystem> system = assembled();
  const Solution kept = run(GetParam(), *system, keeping()), plain = run(GetParam(), *system, {});
  EXPECT_FALSE(plain.solve_again);
  EXPECT_EQ(kept.F_C, plain.F_C);
  EXPECT_EQ(kept.stress, plain.stress);
}

TEST_P(KeptBody, RefusesAnotherBody) {
  const Solution first = run(GetParam(), *assembled(), keeping());
  Scene frictionless, softer;
  frictionless.friction = 0;
  softer.material.young_MPa /= 2;
  for (const auto& problem :
       {posed({}, testing::small_tooth(7, 5)), posed(frictionless), posed(softer)}) {
    const Solution refused = run(first.solve_again, *assemble(GetParam(), problem), {});
    EXPECT_EQ(refused.status, Status::crashed);
    EXPECT_NE(refused.message.find("of another body"), std::string::npos) << refused.message;
  }
}

TEST(KeptBodies, AreNotThoseOfIterations) {
  const AirySystem system = airy_system(posed({}));
  for (const char* method : {"SYMMLQ:SKY", "3STEPCG:SKY"})
    EXPECT_FALSE(run(select_methods(method).front(), system, keeping()).solve_again) << method;
}

}  // namespace
}  // namespace airybench::kept_body_test
