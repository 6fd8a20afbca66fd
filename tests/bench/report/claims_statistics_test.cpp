// The statistics behind the verdicts.
#include "bench/report/claims_statistics.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bench/report/claims_cases.hpp"
#include "solvers/methods.hpp"

namespace airybench::claims_statistics_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ClaimsStatistics, ConjunctionOfVerdicts) {
  using enum Verdict;
  EXPECT_EQ(all_of({}), reproduced);
  EXPECT_EQ(all_of({reproduced, undecided}), undecided);
  EXPECT_EQ(all_of({undecided, not_reproduced, reproduced}), not_reproduced);
  EXPECT_EQ(opposite(reproduced), not_reproduced);
  EXPECT_EQ(opposite(undecided), undecided);
}

TEST(ClaimsStatistics, AnIntervalThatStraddlesTheThresholdDecidesNothing) {
  EXPECT_EQ(is_above({1.1, 1.3}, 1), Verdict::reproduced);
  EXPECT_EQ(is_above({0.9, 1.3}, 1), Verdict::undecided);
  EXPECT_EQ(is_above({0.9, 1}, 1), Verdict::not_reproduced);
  EXPECT_EQ(is_above({3, infinity}, 1), Verdict::reproduced);
  EXPECT_EQ(is_within_factor({0.7, 1.4}, 1.5), Verdict::reproduced);
  EXPECT_EQ(is_within_factor({0.7, 1.6}, 1.5), Verdict::undecided);
  EXPECT_EQ(is_within_factor({0.3, 0.5}, 1.5), Verdict::not_reproduced);
  EXPECT_EQ(is_within_factor({1.6, infinity}, 1.5), Verdict::not_reproduced);
}

TEST(ClaimsStatistics, BootstrapOfTheRatioOfMedians) {
  const CaseTime slow = {2, {2, 2.1, 1.9, 2.2, 1.8}}, fast = {1, {1, 1.05, 0.95, 1, 1}};
  const Ratio ratio = ratio_of(slow, fast);
  EXPECT_DOUBLE_EQ(ratio.figure, 2);
  EXPECT_GE(ratio.interval.low, 1.8 / 1.05);
  EXPECT_LE(ratio.interval.high, 2.2 / 0.95);
  EXPECT_LT(ratio.interval.low, 1.95);
  EXPECT_GT(ratio.interval.high, 2.05);
  EXPECT_EQ(ratio_of(slow, fast).interval.low, ratio.interval.low);  // the seed is fixed
  const Ratio single = ratio_of({3, {3}}, {2, {2}});
  EXPECT_EQ(single.interval.low, 1.5);
  EXPECT_EQ(single.interval.high, 1.5);
}

TEST(ClaimsStatistics, TimedOutCasesEnterWithTheTimeTheySpent) {
  const CaseTime stopped = {100, {}, 10}, measured = {2, {2}};
  const Ratio above = ratio_of(stopped, measured), below = ratio_of(measured, stopped);
  EXPECT_TRUE(above.estimated);
  EXPECT_EQ(above.figure, 50);
  EXPECT_EQ(above.interval.low, 5);
  EXPECT_EQ(above.interval.high, infinity);
  EXPECT_EQ(below.interval.low, 0);
  EXPECT_EQ(below.interval.high, 0.2);
  const Ratio unknown = ratio_of(stopped, stopped);
  EXPECT_EQ(unknown.interval.low, 0);
  EXPECT_EQ(unknown.interval.high, infinity);
}

TEST(ClaimsStatistics, SpreadIsGeometricMeanAndRange) {
  const Ratio all = spread({{2, {1.9, 2.1}}, {8, {7, 9}}});
  EXPECT_DOUBLE_EQ(all.figure, 4);
  EXPECT_EQ(all.interval.low, 2);
  EXPECT_EQ(all.interval.high, 8);
  const Ratio with_timeout = spread({{2, {1.9, 2.1}}, {8, {1, infinity}, true}});
  EXPECT_EQ(with_timeout.interval.low, 1);
  EXPECT_EQ(with_timeout.interval.high, infinity);
}

TEST(ClaimsCases, ThePapersNamesAreTheMethods) {
  for (const auto& [of_paper, general] : paper_names)
    EXPECT_EQ(select_methods(of_paper).front().identity(), general);
}

}  // namespace
}  // namespace airybench::claims_statistics_test
