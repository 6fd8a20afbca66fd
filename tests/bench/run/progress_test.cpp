// The time left, on recorded runs: forecast case by case from the records of others.
#include "bench/run/progress.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/contains.hpp"
#include "tests/support/places.hpp"

namespace airybench::progress_test {
namespace {

TEST(Progress, TheTimeLeftOfARecordedRunIsRightToAFactorOfTwo) {
  // The paper's direct methods, and what other runs on the same machine had measured before.
  const auto recorded = [](const char* folder) {
    return read_past_records({testing::test_data("progress") / folder}).records;
  };
  std::vector<Record> run = recorded("run");
  std::ranges::stable_sort(run, {}, [](const Record& r) { return r.case_number.value_or(0); });
  const auto expected = expected_seconds(forecast(run, recorded("past"), {}));
  ASSERT_EQ(run.size(), 48u);
  double whole_s = 0, all_s = 0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    whole_s += *run[k].wall_s;
    all_s += expected[k].value_or(0);
  }
  double elapsed_s = 0, done_s = 0;
  int shown = 0;
  for (std::size_t k = 0; k + 1 < run.size(); ++k) {
    elapsed_s += *run[k].wall_s;
    done_s += expected[k].value_or(0);
    if (whole_s - elapsed_s < 0.05 * whole_s) break;
    const double left_s = seconds_left(elapsed_s, done_s, all_s - done_s);
    EXPECT_LT(std::abs(std::log(left_s / (whole_s - elapsed_s))), std::log(2))
        << run[k].mesh << " " << run[k].method << ": " << left_s << ", not " << whole_s - elapsed_s;
    ++shown;
  }
  EXPECT_GT(shown, 15);
}

Record planned(const char* method) {
  Record record;
  record.mesh = "Mesh0";
  record.scene = "default";
  record.method = method;
  record.status = Status::ok;
  return record;
}

TEST(Progress, AShortRunAsksNoRecordsAndSaysNothingOfTheTimeLeft) {
  Progress progress({planned("A"), planned("B")}, [](const std::vector<Record>& cases) {
    ADD_FAILURE();
    return std::vector<std::optional<double>>(cases.size());
  });
  const std::string line = progress.line(planned("A"));
  EXPECT_TRUE(testing::contains(line, "[1/2] Mesh0/default/A: ok"));
  EXPECT_FALSE(testing::contains(line, "left"));
}

TEST(Progress, WhatIsExpectedCountsLessAndLess) {
  EXPECT_NEAR(seconds_left(0, 0, 100), 100, 1e-9);
  EXPECT_NEAR(seconds_left(20, 1, 99), 99 * 25. / 6, 1e-9);
  EXPECT_NEAR(seconds_left(180, 90, 10), 10 * 185. / 95, 1e-9);
  EXPECT_EQ(seconds_left(180, 90, 0), 0);
}

}  // namespace
}  // namespace airybench::progress_test
