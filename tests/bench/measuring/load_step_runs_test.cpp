// Cases with load steps: all on one clock, every step judged, the worst decides.
#include "bench/measuring/load_step_runs.hpp"

#include <gtest/gtest.h>

#include "assembly/scene.hpp"
#include "bench/measuring/workbench.hpp"
#include "bench/records/summary.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::load_step_runs_test {
namespace {

std::shared_ptr<const Problem> sheared_and_back() {
  Scene scene;
  scene.displacement_mm = {0.02, 0};
  scene.later_steps.resize(2);
  scene.later_steps[0].displacement_mm = Eigen::Vector2d(0.02, 0.006);
  scene.later_steps[1].displacement_mm = Eigen::Vector2d(0.02, 0);
  return testing::posed(scene);
}

Record examined(const Method& method, Options options = {}) {
  options.repetitions = 1;
  Workbench bench(sheared_and_back(), options);
  const auto [record, choice] = bench.examine(method, {});
  Record result = record;
  if (is_measured(result)) add_run(bench.measure_time(method, choice), result);
  summarise(result);
  return result;
}

TEST(LoadStepRuns, EveryStepIsInTheRecordAndTheLastInItsColumns) {
  for (const Method& method : select_methods("HYBRID,P2,3STEPD:CHOLMOD,BLIND:SCHUR,ALM:AUTO")) {
    const Record record = examined(method);
    EXPECT_EQ(record.outcome, "ok") << method.name << ": " << record.status_reason;
    EXPECT_EQ(record.load_steps, 3);
    ASSERT_EQ(record.steps.size(), 3u) << method.name;
    for (const Json& step : record.steps) {
      EXPECT_EQ(step.at("claimed_status"), "ok");
      EXPECT_LE(step.at("error").get<double>(), 1e-6) << method.name;
    }
    EXPECT_EQ(record.steps[2].at("tangential_resultant_N"), record.tangential_resultant_N);
    EXPECT_EQ(record.steps[2].at("n_slip"), record.n_slip);
    // Sheared it is another than pressed, and the way back leaves forces behind.
    const auto tangential = [&](int k) {
      return record.steps[k].at("tangential_resultant_N").get<double>();
    };
    EXPECT_LT(tangential(1), tangential(0) - 1);
    EXPECT_GT(tangential(2), tangential(0) + 1);
    EXPECT_NEAR(*record.time_per_load_s * 3 + *record.time_once_s, *record.time_s, 1e-9);
  }
}

TEST(LoadStepRuns, AStepThatIsWrongSpoilsTheCase) {
  Method method = select_methods("HYBRID").front();
  // Says ok of every step, but the second, the sheared one, has contact forces too large.
  method.solve = [solve = method.solve, count = 0](const DualSystem& system,
                                                   const RunControl& control) mutable {
    RunControl alone = control;
    alone.keep_body = false;
    Solution solution = solve(system, alone);
    if (count++ % 3 == 1) solution.F_C *= 1.001;
    return solution;
  };
  const Record record = examined(method);
  EXPECT_EQ(record.outcome, "wrong_success");
  EXPECT_TRUE(record.status_reason.starts_with("load step 2 of 3: ")) << record.status_reason;
}

TEST(LoadStepRuns, AStepWithoutAnAnswerIsTheLast) {
  Method method = select_methods("HYBRID").front();
  method.solve = [solve = method.solve, count = 0](const DualSystem& system,
                                                   const RunControl& control) mutable {
    if (count++ == 1) throw Breakdown("no pivot");
    RunControl alone = control;
    alone.keep_body = false;
    return solve(system, alone);
  };
  const Record record = examined(method);
  EXPECT_EQ(record.status, Status::breakdown);
  EXPECT_EQ(record.status_reason, "load step 2 of 3: no pivot");
  EXPECT_EQ(record.steps.size(), 1u);
}

TEST(LoadStepRuns, ASceneWithoutAPathHasOneStep) {
  Options options;
  options.repetitions = 1;
  Workbench bench(testing::posed({}), options);
  const Record record = bench.examine(select_methods("HYBRID").front(), {}).record;
  EXPECT_EQ(record.load_steps, 1);
  EXPECT_TRUE(record.steps.is_null());
}

}  // namespace
}  // namespace airybench::load_step_runs_test
