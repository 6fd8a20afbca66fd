// What is checked of an answer where there is no reference.
#include "bench/verify/moments_check.hpp"

#include <gtest/gtest.h>

#include "assembly/scene.hpp"
#include "bench/verify/verifier.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::moments_check_test {
namespace {

class MomentsCheckTest : public ::testing::Test {
 protected:
  Solution solve(const char* method, double friction) {
    Scene scene;
    scene.friction = friction;
    system_ = assemble(testing::posed(scene, testing::small_tooth(8, 6)), Blocks::contact_points);
    RunControl control;
    control.tolerance = 1e-10;
    return run(select_methods(method).front(), system_, control);
  }
  double worst(const Solution& solution) const {
    return worst_measure(verify(system_, solution, nullptr)).value;
  }
  DualSystem system_;
};

TEST_F(MomentsCheckTest, FindsNothingWrongWithARightAnswer) {
  for (const double friction : {0.2, 0.0})
    for (const char* method : {"HYBRID", "HYBRID:CG"}) {
      const Solution solution = solve(method, friction);
      const Verification v = verify(system_, solution, nullptr);
      ASSERT_TRUE(v.stress_of_moments_off && v.natural_map_residual) << method;
      EXPECT_LT(*v.stress_of_moments_off, 1e-10) << method;
      EXPECT_LT(*v.natural_map_residual, 1e-7) << method;
      EXPECT_LT(v.equilibrium_residual, 1e-7) << method;
      EXPECT_FALSE(v.error_stress || v.error_force || v.reference_error) << method;
    }
}

TEST_F(MomentsCheckTest, SeesEveryPartOfAnAnswerThatIsWrong) {
  const Solution right = solve("HYBRID:CG", 0.2);
  const auto after = [&](auto change) {
    Solution wrong = right;
    change(wrong);
    return worst(wrong);
  };
  EXPECT_LT(worst(right), 1e-7);
  EXPECT_GT(after([](Solution& s) { s.F_C *= 1.001; }), 1e-5);
  EXPECT_GT(after([](Solution& s) {
              for (ElementStress& stress : s.stress) stress *= 1.001;  // it balances but for F_C
            }),
            1e-5);
  EXPECT_GT(after([](Solution& s) { s.edge_moments *= 1.001; }), 1e-5);
  // In balance and compatible, through the wall.
  Scene scene;
  scene.clearance_mm = 1;
  system_ = assemble(testing::posed(scene, testing::small_tooth(8, 6)), Blocks::contact_points);
  EXPECT_GT(worst(right), 1e-5);
}

}  // namespace
}  // namespace airybench::moments_check_test
