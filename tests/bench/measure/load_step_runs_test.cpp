// Cases with load steps: all on one clock, every step judged, the worst decides.
#include "bench/measure/load_step_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>

#include "bench/measure/remarks.hpp"
#include "bench/records/summary.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::load_step_runs_test {
namespace {

using testing::examined;

std::shared_ptr<const Problem> sheared_and_back() {
  Scene scene;
  scene.displacement_mm = {0.02, 0};
  scene.later_steps.resize(2);
  scene.later_steps[0].displacement_mm = Eigen::Vector2d(0.02, 0.006);
  scene.later_steps[1].displacement_mm = Eigen::Vector2d(0.02, 0);
  return testing::posed(scene);
}

Record summarised(const Method& method) {
  Record record = testing::measured(sheared_and_back(), method);
  summarise(record);
  return record;
}

std::vector<double> of_steps(const Record& record, std::optional<double> StepResult::*value) {
  std::vector<double> values;
  for (const StepResult& step : record.steps) values.push_back((step.*value).value());
  return values;
}
std::vector<double> errors_of_steps(const Record& record) {
  std::vector<double> errors;
  for (const StepResult& step : record.steps)
    errors.push_back(step.of_mesh.error_discretisation.value());
  return errors;
}

std::string remarks(const Record& record) {
  Verdict verdict;
  for (const std::string& remark : remarks_on_half_steps(record.steps, record.steps_in_halves))
    verdict.add(remark);
  return verdict.reason;
}

TEST(LoadStepRuns, EveryStepIsInTheRecordAndTheLastInItsColumns) {
  for (const Method& method :
       select_methods("HYBRID,HYBRID:k=2,HYBRID:k=4,P2,P3,3STEPD:CHOLMOD,BLIND:SCHUR,ALM:AUTO")) {
    const Record record = summarised(method);
    EXPECT_EQ(record.outcome, "ok") << method.name << ": " << record.status_reason;
    EXPECT_EQ(record.load_steps, 3);
    ASSERT_EQ(record.steps.size(), 3u) << method.name;
    for (const StepResult& step : record.steps) {
      EXPECT_EQ(step.claimed_status, Status::ok);
      EXPECT_LE(step.error.value(), 1e-6) << method.name;
    }
    EXPECT_EQ(record.steps[2].tangential_resultant_N, record.tangential_resultant_N);
    EXPECT_EQ(record.steps[2].n_slip, record.n_slip);
    // Sheared it is another than pressed, and the way back leaves forces behind.
    const std::vector<double> tangential = of_steps(record, &StepResult::tangential_resultant_N);
    EXPECT_LT(tangential[1], tangential[0] - 1);
    EXPECT_GT(tangential[2], tangential[0] + 1);
    EXPECT_NEAR(*record.time_per_load_s * 3 + *record.time_once_s, *record.time_s, 1e-9);
  }
}

// Pressed by these displacements in turn.
Record pressed_by(const std::vector<double>& displacements_mm, const Method& method) {
  Scene scene;
  scene.displacement_mm = {displacements_mm[0], 0};
  for (std::size_t k = 1; k < displacements_mm.size(); ++k)
    scene.later_steps.emplace_back().displacement_mm = Eigen::Vector2d(displacements_mm[k], 0);
  Record record = testing::measured(testing::posed(scene), method);
  summarise(record);
  return record;
}

TEST(LoadStepRuns, APathMayBeUnloadedAtItsEndAndWithin) {
  for (const Method& method : select_methods("HYBRID,P2,3STEPD:CHOLMOD")) {
    SCOPED_TRACE(method.name);
    for (const double end : {-0.1, 0.}) {  // it touches at 0
      const Record record = pressed_by({0.02, 0.02, end}, method);
      // P2's nodes stick in places of their own, and keep a force.
      const bool is_stuck = method.name == "P2" && end == 0;
      EXPECT_EQ(record.outcome, is_stuck ? "inaccurate" : "ok") << record.status_reason;
      EXPECT_EQ(std::abs(record.normal_resultant_N.value_or(1)) > 1e-9, is_stuck);
    }
    EXPECT_EQ(pressed_by({-0.1, -0.1, -0.1}, method).outcome, "unstressed");
    if (method.name == "3STEPD:CHOLMOD") continue;
    const Record within = pressed_by({0.02, 0.02, 0, 0.02}, method);
    EXPECT_EQ(within.outcome, method.name == "P2" ? "inaccurate" : "ok") << within.status_reason;
    EXPECT_EQ(within.status_reason.starts_with("load step 3 of 4: "), method.name == "P2");
  }
}

// The next step starts from it: then everything after is another problem's, and looks right.
TEST(LoadStepRuns, AWrongSlipIsSeen) {
  for (Method method : select_methods("HYBRID,HYBRID:k=2,P2,3STEPD:CHOLMOD,ALM:AUTO")) {
    int solves = 0;
    method.solve = [&, right = method.solve](const ContactSystem& system,
                                             const RunControl& control) {
      RunControl alone = control;
      alone.keep_body = false;
      Solution solution = right(system, alone);
      if (++solves == 2) solution.contact_displacement *= 1.01;
      return solution;
    };
    Record record = examined(sheared_and_back(), method);
    summarise(record);
    EXPECT_EQ(record.status, Status::inaccurate) << method.name;
    EXPECT_EQ(record.outcome, method.in_displacements() ? "unverified" : "wrong_success");
  }
}

TEST(LoadStepRuns, AStepThatIsNoNumberIsTheWorst) {
  std::vector<JudgedStep> steps(4, JudgedStep{Status::ok, {}});
  for (std::size_t k = 0; k < steps.size(); ++k)
    steps[k].verification.equilibrium_residual = k == 1 ? std::nan("") : 1e-9 * double(k);
  EXPECT_EQ(worst_step(steps), 1u);
  steps[1].verification.equilibrium_residual = 1;
  EXPECT_EQ(worst_step(steps), 1u);
}

TEST(LoadStepRuns, APathWithFrictionIsSolvedInHalfStepsToo) {
  Scene scene;
  const auto examined_in = [&](int steps, double friction, const char* method = "HYBRID") {
    scene.equal_steps = steps;
    scene.friction = friction;
    return examined(testing::posed(scene, testing::small_tooth(16, 12)), method);
  };
  EXPECT_TRUE(examined_in(1, 0.2).steps_in_halves.empty());
  EXPECT_TRUE(examined_in(1, 0.2).in_eight_steps.empty());  // not asked for
  EXPECT_TRUE(examined_in(2, 0).steps_in_halves.empty());
  const Record two = examined_in(2, 0.2), four = examined_in(4, 0.2);
  ASSERT_EQ(two.steps_in_halves.size(), 2u);
  for (const int k : {0, 1}) {
    const StepResult &halved = two.steps_in_halves[k], &second = four.steps[2 * k + 1];
    for (const auto count : {&StepResult::n_open, &StepResult::n_stick, &StepResult::n_slip})
      EXPECT_EQ(halved.*count, second.*count);
    for (const auto force : {&StepResult::normal_resultant_N, &StepResult::tangential_resultant_N})
      EXPECT_NEAR((halved.*force).value() / (second.*force).value(), 1, 1e-9);
    const std::vector<double> dissipated = of_steps(four, &StepResult::dissipation_Nmm);
    EXPECT_NEAR(halved.dissipation_Nmm.value(), dissipated[2 * k] + dissipated[2 * k + 1], 1e-9);
  }
  EXPECT_NE(two.steps.back().n_stick, two.steps_in_halves.back().n_stick);
  EXPECT_TRUE(testing::contains(two.status_reason, "with every load step in two halves "));
  EXPECT_EQ(examined_in(2, 0.2, "P2").steps_in_halves, two.steps_in_halves);
  const Record of_degree = examined_in(2, 0.2, "HYBRID:k=3");
  ASSERT_EQ(of_degree.steps_in_halves.size(), 2u);
  for (const StepResult& halved : of_degree.steps_in_halves)  // its own points
    EXPECT_EQ(halved.n_open.value() + halved.n_stick.value() + halved.n_slip.value(),
              *of_degree.n_open + *of_degree.n_stick + *of_degree.n_slip);
}

StepResult made_up(int stick, int slip, double tangential_N, double energy_Nmm = 50,
                   double dissipation_Nmm = 1) {
  StepResult result;
  result.claimed_status = Status::ok;
  result.normal_resultant_N = -100;
  result.tangential_resultant_N = tangential_N;
  result.n_stick = stick;
  result.n_slip = slip;
  result.strain_energy_Nmm = energy_Nmm;
  result.dissipation_Nmm = dissipation_Nmm;
  return result;
}

// Fretting's first step sticks in 10 points, in two halves in 18; its last one is the same in both.
TEST(LoadStepRuns, TheNoteOnHalvesNamesTheWorstStep) {
  Record record;
  record.steps = {made_up(10, 15, 0), made_up(20, 5, 10), made_up(0, 25, 20)};
  record.steps_in_halves = {made_up(18, 7, 0), made_up(21, 4, 10.05), made_up(0, 25, 20)};
  EXPECT_TRUE(testing::contains(remarks(record),
                                "2 of 3 steps end otherwise, step 1 most: 18 points stick and 7 "
                                "slip, not 10 and 15; F = (-100, 0) N, not (-100, 0)"));
  record.steps_in_halves = record.steps;
  EXPECT_EQ(remarks(record), "");
  record.steps_in_halves[2].tangential_resultant_N = 25;
  EXPECT_TRUE(testing::contains(remarks(record), "1 of 3 steps end otherwise, step 3 most"));
}

// −8.98e-17 N mm instead of 2.43e-16: of a path that stores 50 N mm, both are none.
TEST(LoadStepRuns, DissipationInHalvesIsRelativeToTheLargestStrainEnergy) {
  for (const auto& [whole_Nmm, halved_Nmm, said] :
       {std::tuple(2.43e-16, -8.98e-17, ""),
        {1e-6, 0., ""},
        {0., 0., ""},
        {0.1, 0.08, "friction dissipates 0.08 N mm, not 0.1"},
        {0.1, -8.98e-17, "friction dissipates 0 N mm, not 0.1"}}) {
    Record record;  // it ends unloaded
    record.steps = {made_up(10, 0, 5, 50, whole_Nmm), made_up(10, 0, 5, 0, 0)};
    record.steps_in_halves = {made_up(10, 0, 5, 50, halved_Nmm), made_up(10, 0, 5, 0, 0)};
    EXPECT_TRUE(remarks(record).ends_with(said)) << remarks(record);
    EXPECT_EQ(remarks(record).empty(), std::string_view(said).empty()) << remarks(record);
  }
}

TEST(LoadStepRuns, ALoadCaseIsSolvedInEightStepsTooWhereItIsAsked) {
  Scene scene;
  const auto examined_in = [&](int steps, double friction, const char* method) {
    scene.equal_steps = steps;
    scene.friction = friction;
    Options options;
    options.run.cases.in_eight_steps = true;
    return examined(testing::posed(scene, testing::small_tooth(16, 12)), method, options);
  };
  for (const char* method : {"HYBRID", "HYBRID:k=2", "3STEPD"}) {
    const Record once = examined_in(1, 0.2, method), path = examined_in(8, 0.2, method);
    ASSERT_EQ(once.in_eight_steps.size(), 1u) << method;
    const StepResult &eighth = once.in_eight_steps.back(), &last = path.steps.back();
    for (const auto value : {&StepResult::normal_resultant_N, &StepResult::tangential_resultant_N,
                             &StepResult::largest_pressure_MPa})
      EXPECT_NEAR((eighth.*value).value() / (last.*value).value(), 1, 1e-6) << method;
    EXPECT_TRUE(once.steps_in_halves.empty() && path.in_eight_steps.empty());
  }
  EXPECT_TRUE(examined_in(1, 0, "HYBRID").in_eight_steps.empty());    // nothing slips
  EXPECT_TRUE(examined_in(1, 1.5, "HYBRID").in_eight_steps.empty());  // all sticks
}

// What presses in the first of two steps is rounding: nothing is relative to it.
TEST(LoadStepRuns, AStepInWhichBodiesJustTouchIsNoMatter) {
  Scene scene = testing::pressed(0.1, {0.0013, -0.0206});
  scene.contacts.front().clearance_mm = 0.0103;
  scene.equal_steps = 2;
  const auto path = testing::posed(scene, testing::two_blocks(7, 5));
  for (const char* method : {"HYBRID", "HYBRID:k=2", "HYBRID:PDAS", "P2", "3STEPD"}) {
    const Record record = examined(path, method);
    EXPECT_EQ(record.status, Status::ok) << method << ": " << record.status_reason;
    EXPECT_LT(record.contact_iterations.value_or(0), 100) << method;
    ASSERT_EQ(record.steps.size(), 2u);
    EXPECT_NEAR(record.steps[0].normal_resultant_N.value(), 0, 1e-6) << method;
    EXPECT_LT(record.steps[1].normal_resultant_N.value(), -1) << method;
  }
}

// Without friction nothing is remembered: the last of several equal steps is the single one.
TEST(LoadStepRuns, EveryStepHasItsTotalErrorBoundsAndIntervals) {
  Scene scene;
  scene.friction = 0;
  const auto examined_in = [&](int steps, const char* method) {
    scene.equal_steps = steps;
    Options options;
    options.run.cases.fields = true;
    return examined(testing::posed(scene), method, options);
  };
  for (const char* method : {"HYBRID", "P2", "P3"}) {
    const Record once = examined_in(1, method), path = examined_in(3, method);
    ASSERT_TRUE(once.error_discretisation && path.error_discretisation) << method;
    EXPECT_NEAR(*path.lower_bound_Nmm / *once.lower_bound_Nmm, 1, 1e-9);
    ASSERT_EQ(path.steps.size(), 3u);
    const std::vector<double> errors = errors_of_steps(path);
    EXPECT_NEAR(errors[2] / *once.error_discretisation, 1, 1e-6) << method;
    EXPECT_EQ(*path.error_discretisation, std::ranges::max(errors));
    for (const StepResult& step : path.steps)
      EXPECT_LT(step.of_mesh.lower_bound_Nmm.value(), step.of_mesh.upper_bound_Nmm.value());
  }
  const Record path = examined_in(3, "HYBRID");
  for (const StepResult& step : path.steps) {
    EXPECT_LE(step.of_mesh.normal_resultant_low_N.value(), step.normal_resultant_N.value());
    EXPECT_EQ(step.dissipation_Nmm, 0);
  }
}

// u_t is less what slipped before: the way back would else have an error of its past.
TEST(LoadStepRuns, WithFrictionTheErrorOfAStepIsOfItsOwnSlip) {
  Options options;
  options.run.cases.fields = true;
  for (const char* method : {"HYBRID", "HYBRID:k=3", "P2", "P3"}) {
    const Record record = examined(sheared_and_back(), method, options);
    ASSERT_EQ(record.steps.size(), 3u);
    const std::vector<double> error = errors_of_steps(record),
                              dissipated = of_steps(record, &StepResult::dissipation_Nmm);
    EXPECT_LT(error[2], 1.3 * error[0]) << method;
    EXPECT_GE(std::ranges::min(dissipated), -1e-12) << method;
    EXPECT_GT(std::reduce(dissipated.begin(), dissipated.end()), 1e-4) << method;
  }
}

// HYBRID, on its own in every step, with this done to the second answer.
Method disturbed(const std::function<void(Solution&)>& disturb) {
  Method method = select_methods("HYBRID").front();
  method.solve = [=, solve = method.solve, count = 0](const ContactSystem& system,
                                                      RunControl control) mutable {
    control.keep_body = false;
    Solution solution = solve(system, control);
    if (count++ % 3 == 1) disturb(solution);
    return solution;
  };
  return method;
}

TEST(LoadStepRuns, AStepThatIsWrongSpoilsTheCase) {
  const Record record = summarised(disturbed([](Solution& second) { second.F_C *= 1.001; }));
  EXPECT_EQ(record.outcome, "wrong_success");
  EXPECT_TRUE(record.status_reason.starts_with("load step 2 of 3: ")) << record.status_reason;
}

TEST(LoadStepRuns, AStepWithoutAnAnswerIsTheLast) {
  const Record record = summarised(disturbed([](Solution&) { throw Breakdown("no pivot"); }));
  EXPECT_EQ(record.status, Status::breakdown);
  EXPECT_EQ(record.status_reason, "load step 2 of 3: no pivot");
  EXPECT_EQ(record.steps.size(), 1u);
}

TEST(LoadStepRuns, ASceneWithoutAPathHasOneStep) {
  const Record record = examined(testing::posed({}), "HYBRID");
  EXPECT_EQ(record.load_steps, 1);
  EXPECT_TRUE(record.steps.empty());
}

}  // namespace
}  // namespace airybench::load_step_runs_test
