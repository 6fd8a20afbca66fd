#include "bench/tracking/compare.hpp"

#include <gtest/gtest.h>

#include "bench/tracking/compare_report.hpp"

namespace airybench::compare_test {
namespace {

Record record(const std::string& method, double time_s, int repetitions = 9) {
  Record result;
  result.mesh = "Mesh0";
  result.scene = "default";
  result.method = method;
  result.status = Status::ok;
  for (int i = 0; i < repetitions; ++i) result.samples_s.push_back(time_s * (1 + 0.001 * i));
  result.time_s = result.samples_s[repetitions / 2];
  return result;
}

TimeVerdict verdict(const Comparison& comparison) { return comparison.cases.at(0).verdict; }

// One case that takes `ratio` times as long while the kernel takes `drift` times as long.
Comparison compared(double ratio, std::optional<double> drift = {}, int repetitions = 9) {
  Record a = record("3STEPD", 1, repetitions), b = record("3STEPD", 1.00001 * ratio, repetitions);
  if (drift) {
    a.noise_kernel_s = 0.1;
    b.noise_kernel_s = 0.1 * *drift;
  }
  return compare({a}, {b}, {});
}

TEST(Compare, SlowerFasterAndNotSeparated) {
  EXPECT_EQ(verdict(compared(1.1)), TimeVerdict::slower);
  EXPECT_EQ(verdict(compared(0.9)), TimeVerdict::faster);
  EXPECT_EQ(verdict(compared(1)), TimeVerdict::not_separated);
  EXPECT_EQ(verdict(compared(1.02)), TimeVerdict::not_separated);  // below the minimum effect
  EXPECT_TRUE(compared(1.1).has_regression());
  EXPECT_FALSE(compared(0.9).has_regression());
  EXPECT_NEAR(compared(1.1).cases[0].ratio, 1.1, 1e-4);
}

TEST(Compare, AnEffectMustExceedTheDrift) {
  EXPECT_EQ(verdict(compared(1.2, 1.2)), TimeVerdict::not_separated);
  EXPECT_EQ(verdict(compared(1.25, 1.2)), TimeVerdict::not_separated);  // 1.04 by the drift
  EXPECT_EQ(verdict(compared(1.5, 1.2)), TimeVerdict::slower);
  EXPECT_EQ(verdict(compared(0.9, 0.8)), TimeVerdict::not_separated);  // raw faster, else slower
  EXPECT_EQ(verdict(compared(1.1, 0.95)), TimeVerdict::slower);
  EXPECT_EQ(verdict(compared(0.5, 0.8)), TimeVerdict::faster);
  EXPECT_FALSE(compared(1.1).drift);
}

TEST(Compare, SaysWhenNoPCouldBeSmallEnough) {
  const Comparison few = compared(1.5, {}, 3);
  EXPECT_EQ(verdict(few), TimeVerdict::too_few_samples);
  EXPECT_EQ(few.repetitions_needed, 4u);
  EXPECT_NE(comparison_text(few).find("4 repetitions on both sides would do"), std::string::npos);
  EXPECT_FALSE(few.has_regression());
}

TEST(Compare, MatchesCasesByAllThatMakesThem) {
  Record paper = record("ALM", 1), point = record("ALM", 1), target = record("ALM", 1);
  paper.stop = Stop::paper;
  target.stop = Stop::target;
  point.study = "error";
  point.knob = "tolerance";
  point.knob_value = 0.01;
  const Comparison comparison =
      compare({record("ALM", 1), paper, point}, {point, target, record("P2", 1)}, {});
  ASSERT_EQ(comparison.cases.size(), 2u);  // without a stop and with the target are one
  EXPECT_EQ(comparison.only_a, std::vector<std::string>{"Mesh0/default/ALM/stop=paper"});
  EXPECT_EQ(comparison.only_b, std::vector<std::string>{"Mesh0/default/P2"});
  EXPECT_EQ(name_of(comparison.cases[1].a).text(), "Mesh0/default/ALM/study=error/tolerance=0.01");
}

TEST(Compare, ABrokenCaseIsARegressionAndOtherChangesAreNamed) {
  Record a = record("ALM", 1), b = record("ALM", 1);
  b.status = Status::inaccurate;
  a.error_force = 1e-7;
  b.error_force = 2e-6;
  a.linear_iterations = 10;
  b.linear_iterations = 12;
  const Comparison comparison = compare({a, record("P2", 1)}, {b, record("P2", 1)}, {});
  EXPECT_TRUE(comparison.has_regression());
  for (const std::string& text : {comparison_text(comparison), comparison_markdown(comparison)}) {
    EXPECT_NE(text.find("Mesh0/default/ALM: status ok → inaccurate\n"), std::string::npos) << text;
    EXPECT_NE(text.find("ALM: error_force 1e-07 → 2e-06\n"), std::string::npos) << text;
    EXPECT_NE(text.find("ALM: linear_iterations 10 → 12\n"), std::string::npos) << text;
  }
  EXPECT_EQ(comparison_json(comparison)["regression"], true);
}

TEST(Compare, TheGeometricMeanIsOverTheTimedCases) {
  Record crashed = record("BLIND", 1);
  crashed.status = Status::crashed;
  const Comparison comparison = compare({record("ALM", 1), record("P2", 1), crashed},
                                        {record("ALM", 2), record("P2", 0.5), crashed}, {});
  EXPECT_EQ(comparison.timed, 2u);
  EXPECT_DOUBLE_EQ(comparison.mean_ratio, 1);
  EXPECT_LE(comparison.mean_interval.low, 1);
  EXPECT_GE(comparison.mean_interval.high, 1);
  EXPECT_FALSE(compare({crashed}, {crashed}, {}).has_regression());
}

}  // namespace
}  // namespace airybench::compare_test
