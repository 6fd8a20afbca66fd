// --tuning-budget: the search for parameters and tolerances ends with the best found, and says so.
#include <gtest/gtest.h>

#include "tests/support/contains.hpp"

#include "tests/bench/measure/examined.hpp"

namespace airybench::tuning_budget_test {
namespace {

constexpr double next_to_nothing_s = 1e-9, plenty_s = 1000;

Record examined(const Method& method, std::optional<double> budget_s) {
  Options options;
  options.limits.tuning_budget_s = budget_s;
  return testing::examined(testing::posed(Scene(), testing::small_tooth(6, 4)), method, options);
}

// SYMMLQ that begins with a tolerance of 1e-5, and has to be tightened.
Method loose() {
  Method method = select_methods("SDTIC6").front();
  method.first_tolerance = 10;
  return method;
}

TEST(TuningBudget, TighteningGoesOnUntilItIsSpent) {
  for (const std::optional<double> budget_s : {std::optional<double>(), {plenty_s}}) {
    const Record record = examined(loose(), budget_s);
    EXPECT_EQ(record.status, Status::ok) << record.status_reason;
    EXPECT_GT(record.attempts.size(), 1u);
    EXPECT_FALSE(record.tuning_cut);
    EXPECT_EQ(record.tuning_budget_s, budget_s);
  }
  const Record cut = examined(loose(), next_to_nothing_s);
  EXPECT_EQ(cut.attempts.size(), 1u);
  EXPECT_TRUE(cut.tuning_cut);
  EXPECT_EQ(cut.status, Status::inaccurate);
  EXPECT_TRUE(testing::contains(cut.status_reason, "the search was cut"));
  EXPECT_TRUE(cut.error_force);
}

TEST(TuningBudget, AFirstToleranceThatDoesIsNoSearch) {
  const Record record = examined(select_methods("SDTIC6").front(), next_to_nothing_s);
  EXPECT_EQ(record.status, Status::ok) << record.status_reason;
  EXPECT_FALSE(record.tuning_cut);
}

TEST(TuningBudget, AGridThatHasNothingYetIsATimeout) {
  const Method alm = select_methods("ALM").front();
  const Record record = examined(alm, next_to_nothing_s);
  EXPECT_EQ(record.status, Status::timeout);
  EXPECT_TRUE(record.tuning_cut);
  EXPECT_TRUE(testing::contains(record.status_reason, "while choosing parameters"));
  EXPECT_EQ(examined(alm, plenty_s).status, Status::ok);
}

// What the search found before its time was over is kept.
TEST(TuningBudget, AGridThatWasCutKeepsItsBest) {
  Method method = select_methods("ALM:r=20,rho=20").front();
  method.tune = [solve = method.solve](const ContactSystem&, const RunControl&) {
    return Tuning{"r=20, rho=20", solve, {{20, 20, 100, "converged"}, {40, 20, 0, "not tried"}}};
  };
  const Record record = examined(method, plenty_s);
  EXPECT_EQ(record.status, Status::ok) << record.status_reason;
  EXPECT_TRUE(record.tuning_cut);
}

TEST(TuningBudget, IsTheLimitOfTuningAlone) {
  Limits limits;
  limits.timeout_s = 5;
  EXPECT_EQ(run_limit_s(Activity::tuning, limits), 5);
  limits.tuning_budget_s = 7;
  EXPECT_EQ(run_limit_s(Activity::tuning, limits), 7);
  EXPECT_EQ(run_limit_s(Activity::detail_run, limits), 5);
}

}  // namespace
}  // namespace airybench::tuning_budget_test
