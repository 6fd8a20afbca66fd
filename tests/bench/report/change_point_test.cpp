#include "bench/report/change_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/bench/report/synthetic_history.hpp"

namespace airybench::change_point_test {
namespace {

std::vector<double> flat(std::size_t nights, double scatter, unsigned seed) {
  testing::Random random(seed);
  std::vector<double> series(nights);
  for (double& x : series) x = random.normal(scatter);
  return series;
}

void raise(std::vector<double>& series, std::size_t first, double by) {
  for (std::size_t t = first; t < series.size(); ++t) series[t] += by;
}

TEST(ChangePoint, FindsTheNightAndTheShift) {
  for (const double shift : {0.15, -0.15}) {
    std::vector<double> series = flat(30, 0.02, 3);
    raise(series, 24, shift);
    const std::optional<Change> change = find_change(series, 0.02, {});
    ASSERT_TRUE(change);
    EXPECT_EQ(change->first, 24u);
    EXPECT_NEAR(change->shift, shift, 0.03);
    EXPECT_LT(change->low, shift);
    EXPECT_GT(change->high, shift);
  }
}

TEST(ChangePoint, WaitsForEnoughNights) {
  std::vector<double> series = flat(30, 0.01, 4);
  raise(series, 27, 0.3);
  EXPECT_FALSE(find_change(series, 0.01, {}));  // three
  series.push_back(0.3);
  EXPECT_TRUE(find_change(series, 0.01, {}));
  EXPECT_FALSE(find_change({series.begin() + 20, series.end()}, 0.01, {}));  // seven before
  EXPECT_TRUE(find_change({series.begin() + 19, series.end()}, 0.01, {}));
}

TEST(ChangePoint, SmallOrSingleOrDisagreeingIsNoChange) {
  std::vector<double> small = flat(40, 0.005, 5);
  raise(small, 30, 0.03);
  EXPECT_FALSE(find_change(small, 0.005, {}));
  std::vector<double> outliers = flat(40, 0.02, 6);
  for (const std::size_t t : {20, 36, 37, 39}) outliers[t] += 0.4;
  EXPECT_FALSE(find_change(outliers, 0.02, {}));
  std::vector<double> dispersed = flat(40, 0.02, 7);
  double by = 0.1;
  for (std::size_t t = 36; t < 40; ++t) dispersed[t] += by += 0.12;
  EXPECT_FALSE(find_change(dispersed, 0.02, {}));
}

TEST(ChangePoint, PassesOverNightsThatWereNotMeasured) {
  std::vector<double> series = flat(30, 0.02, 8);
  raise(series, 22, 0.2);
  for (const std::size_t t : {3, 10, 22, 26}) series[t] = std::nan("");
  const std::optional<Change> change = find_change(series, 0.02, {});
  ASSERT_TRUE(change);
  EXPECT_EQ(change->first, 23u);
  EXPECT_FALSE(find_change(std::vector<double>(20, std::nan("")), 0.02, {}));
  EXPECT_FALSE(find_change({}, 0.02, {}));
  EXPECT_TRUE(std::isnan(scale_of({1, std::nan("")})));
}

TEST(ChangePoint, TheScaleIsNotThatOfOutliers) {
  std::vector<double> series = flat(60, 0.02, 9);
  for (const std::size_t t : {5, 15, 25}) series[t] += 0.4;
  EXPECT_NEAR(scale_of(series), 0.02, 0.01);             // the standard deviation is 0.09
  EXPECT_GT(scale_of(std::vector<double>(10, 1.0)), 0);  // equal values are not without scatter
}

// Seven cases, equal nights but for a factor that all share.
TimeTable table_of(std::size_t cases, std::size_t nights) {
  TimeTable table;
  testing::Random random(10);
  table.log_times.resize(cases);
  table.starts.resize(cases, 0);
  for (std::size_t t = 0; t < nights; ++t) {
    const double night = random.normal(0.1);
    for (auto& series : table.log_times) series.push_back(night + random.normal(0.01));
    table.log_kernel.push_back(night + random.normal(0.01));
  }
  return table;
}

TEST(JudgeTimes, AReportedChangeIsNotReportedAgain) {
  TimeTable table = table_of(8, 40);
  raise(table.log_times[2], 30, 0.2);
  const std::vector<TimeChange> changes = find_time_changes(table, {});
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].series, 2u);
  EXPECT_EQ(changes[0].change.first, 30u);
  table.starts[2] = 30;
  EXPECT_TRUE(find_time_changes(table, {}).empty());
}

TEST(JudgeTimes, FewCasesAreHeldAgainstTheKernel) {
  TimeTable table = table_of(2, 40);
  raise(table.log_times[0], 34, 0.2);
  raise(table.log_times[1], 34, 0.2);  // with a median of two cases both would vanish
  EXPECT_EQ(find_time_changes(table, {}).size(), 2u);
  table.log_kernel.assign(40, std::nan(""));
  EXPECT_TRUE(find_time_changes(table, {}).empty());
}

TEST(JudgeTimes, TheCommonFactorIsHeldAgainstTheKernel) {
  TimeTable table = table_of(8, 40);
  for (auto& series : table.log_times) raise(series, 34, 0.2);
  const std::vector<TimeChange> changes = find_time_changes(table, {});
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_FALSE(changes[0].series);
  table.common_start = changes[0].change.first;
  EXPECT_TRUE(find_time_changes(table, {}).empty());
  table.common_start = 0;
  table.log_kernel.assign(40, std::nan(""));  // no kernel: whose fault it is cannot be said
  EXPECT_TRUE(find_time_changes(table, {}).empty());
}

}  // namespace
}  // namespace airybench::change_point_test
