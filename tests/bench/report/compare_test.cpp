#include "bench/report/compare.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/contains.hpp"

namespace airybench::compare_test {
namespace {

Record record(const std::string& method, double time_s, int repetitions = 9) {
  Record result;
  result.mesh = "Mesh0";
  result.scene = "default";
  result.method = method;
  result.status = Status::ok;
  for (int i = 0; i < repetitions; ++i) result.samples_s.push_back(time_s * (1 + 0.001 * i));
  return result;
}

std::string date(int minute) {
  return fmt::format("2026-11-22T{:02}:{:02}:00Z", minute / 60, minute % 60);
}

struct Sides {
  Runs a, b;
};

// A, B, A, B, …: one case that takes `ratio` times as long in B, in runs that differ by chance,
// while the kernel takes `drift` times as long.
Sides interleaved(double ratio, std::optional<double> drift = {}, int runs = 4) {
  Sides sides;
  for (int run = 0; run < runs; ++run) {
    Record a = record("3STEPD", 1 + 0.003 * run),
           b = record("3STEPD", ratio * (1.001 + 0.003 * run));
    a.context["date"] = date(2 * run);
    b.context["date"] = date(2 * run + 1);
    if (drift) {
      a.noise_kernel_s = 0.1;
      b.noise_kernel_s = 0.1 * *drift;
    }
    sides.a.push_back({a});
    sides.b.push_back({b});
  }
  return sides;
}

Comparison compared(const Sides& sides) { return compare(sides.a, sides.b, {}); }
TimeVerdict verdict(const Sides& sides) { return compared(sides).cases.at(0).verdict; }

using enum TimeVerdict;

TEST(Compare, AnEffectMustExceedTheMinimumAndTheDrift) {
  struct Effect {
    double ratio;
    std::optional<double> drift;
    TimeVerdict verdict;
  };
  for (const auto& [ratio, drift, expected] :
       {Effect{1.1, {}, slower}, Effect{0.9, {}, faster}, Effect{1, {}, not_separated},
        Effect{1.02, {}, not_separated},  // below the minimum effect
        Effect{1.2, 1.2, not_separated}, Effect{1.25, 1.2, not_separated},  // 1.04 by the drift
        Effect{0.9, 0.8, not_separated},  // raw faster, else slower
        Effect{1.5, 1.2, slower}, Effect{1.1, 0.95, slower}, Effect{0.5, 0.8, faster}}) {
    const Comparison comparison = compared(interleaved(ratio, drift));
    EXPECT_EQ(comparison.cases.at(0).verdict, expected) << ratio << ", " << drift.value_or(1);
    EXPECT_EQ(comparison.has_regression(), expected == slower);
    EXPECT_NEAR(comparison.cases[0].ratio, ratio, 2e-3);
    EXPECT_EQ(comparison.drift.has_value(), drift.has_value());
  }
}

// Four runs a side of a program that takes 1 ms in A and 4 ms in B, next to `ours_s` of our own
// time that scatters by 3 %.
Sides of_program(double ours_s, bool is_old_record = false) {
  Sides sides = interleaved(1);
  for (Runs* runs : {&sides.a, &sides.b})
    for (std::size_t run = 0; run < runs->size(); ++run) {
      Record& one = (*runs)[run][0];
      const double own_s = runs == &sides.a ? 1e-3 : 4e-3;
      one.method = "EXTERNAL:mine";
      one.program = "1.0";
      one.samples_s = {own_s + ours_s * (1 + 0.01 * static_cast<double>(run))};
      if (!is_old_record) one.program_solve_samples_s = {own_s};
    }
  return sides;
}

TEST(Compare, OfAProgramItsOwnSolveIsJudged) {
  for (const double ours_s : {0.011, 1.}) {
    const Comparison comparison = compared(of_program(ours_s));
    EXPECT_NEAR(comparison.cases.at(0).ratio, 4, 1e-12);
    EXPECT_EQ(comparison.cases[0].verdict, slower);
    for (const std::string& text : {comparison.text(), comparison.markdown()})
      EXPECT_TRUE(testing::contains(text, "program's own solve"));
    EXPECT_EQ(comparison.json()["cases"][0]["time"], "program_solve_s");
  }
  const Comparison old = compared(of_program(0.011, true));
  EXPECT_NEAR(old.cases.at(0).ratio, 1.25, 0.02);
  EXPECT_EQ(old.json()["cases"][0]["time"], "time_s");
  EXPECT_FALSE(testing::contains(old.text(), "program's own solve"));
}

TEST(Compare, OneRunEachIsNotSeparatedHoweverManyRepetitions) {
  const Comparison one =
      compare({{record("3STEPD", 1, 1000)}}, {{record("3STEPD", 1.6, 1000)}}, {});
  EXPECT_EQ(one.cases.at(0).verdict, one_run_each);
  EXPECT_FALSE(one.has_regression());
  EXPECT_FALSE(one.cases[0].interval) << "nothing is known of the scatter of runs";
  EXPECT_EQ(one.runs_needed, 4u);
  for (const std::string& text : {one.text(), one.markdown()})
    EXPECT_TRUE(testing::contains(text, "not separated: one run each"));
}

TEST(Compare, SaysHowManyRunsWouldDo) {
  const Comparison few = compared(interleaved(1.5, {}, 3));
  EXPECT_EQ(few.cases.at(0).verdict, too_few_runs);
  EXPECT_EQ(few.runs_needed, 4u);
  EXPECT_FALSE(few.has_regression());
}

TEST(Compare, RunsMustHaveBeenInterleaved) {
  const Sides good = interleaved(1.5);
  Sides first_all_of_a = good, no_dates = good, at_once = good, abba = good;
  for (int run = 0; run < 4; ++run) {
    first_all_of_a.a[run][0].context["date"] = date(run);
    first_all_of_a.b[run][0].context["date"] = date(4 + run);
    no_dates.b[run][0].context.clear();
    at_once.b[run][0].context["date"] = date(2 * run);
    if (run % 2 == 1) std::swap(abba.a[run][0].context["date"], abba.b[run][0].context["date"]);
  }
  for (const Sides& sides : {good, at_once, abba}) EXPECT_EQ(verdict(sides), slower);
  for (const Sides& sides : {first_all_of_a, no_dates}) EXPECT_EQ(verdict(sides), not_interleaved);
  EXPECT_FALSE(compared(first_all_of_a).has_regression());
}

// Runs of two programs whose times differ by `ratio`. Every run has its pace, which all
// its repetitions and cases share and which drifts from run to run.
Sides drifting(double ratio, unsigned seed, int runs, int cases) {
  std::mt19937 engine(seed);
  const auto scatter = [&](double size) {  // the engine's own numbers: equal on every machine
    return size * (2.0 * static_cast<double>(engine()) / std::mt19937::max() - 1);
  };
  Sides sides;
  double drift = 0;
  for (int run = 0; run < 2 * runs; ++run) {
    drift = 0.7 * drift + scatter(0.05);
    const bool is_b = run % 2 == 1;
    std::vector<Record>& records = (is_b ? sides.b : sides.a).emplace_back();
    for (int c = 0; c < cases; ++c) {
      const double pace = std::exp(drift + scatter(0.03)) * (is_b ? ratio : 1);
      Record& one = records.emplace_back(record("METHOD" + std::to_string(c), 0.01, 0));
      for (int i = 0; i < 11; ++i)
        one.samples_s.push_back(0.01 * (1 + c) * pace * std::exp(scatter(0.005)));
      one.context["date"] = date(run);
    }
  }
  return sides;
}

// The rule that compare's replaced took every repetition for a run.
Runs repetitions_as_runs(const Record& run, int first_minute) {
  Runs runs;
  for (const double sample : run.samples_s) {
    Record one = run;
    one.samples_s = {sample};
    one.context["date"] = date(2 * static_cast<int>(runs.size()) + first_minute);
    runs.push_back({one});
  }
  return runs;
}

TEST(Compare, WhatARunsRepetitionsShareIsNoRegression) {
  int by_runs = 0, by_repetitions = 0;
  constexpr unsigned tries = 200;
  for (unsigned seed = 1; seed <= tries; ++seed) {
    const Sides sides = drifting(1, seed, 6, 2);
    by_runs += compared(sides).has_regression() ? 1 : 0;
    const Sides as_runs = {repetitions_as_runs(sides.a[0][0], 0),
                           repetitions_as_runs(sides.b[0][0], 1)};
    by_repetitions += compared(as_runs).has_regression() ? 1 : 0;
  }
  EXPECT_LE(by_runs, static_cast<int>(tries / 40));
  EXPECT_GE(by_repetitions, static_cast<int>(tries / 10)) << "this test has no drift to see";
}

TEST(Compare, AShiftByAFifthIsFoundThroughTheDrift) {
  int found = 0;
  constexpr unsigned tries = 100;
  for (unsigned seed = 1; seed <= tries; ++seed)
    found += compared(drifting(1.2, seed, 6, 4)).has_regression() ? 1 : 0;
  EXPECT_GE(found, 95);
}

TEST(Compare, MatchesCasesByAllThatMakesThem) {
  Record paper = record("ALM", 1), point = record("ALM", 1), target = record("ALM", 1);
  paper.stop = Stop::paper;
  target.stop = Stop::target;
  point.study = "error";
  point.knob = "tolerance";
  point.knob_value = 0.01;
  const Comparison comparison =
      compare({{record("ALM", 1), paper, point}}, {{point, target, record("P2", 1)}}, {});
  ASSERT_EQ(comparison.cases.size(), 2u);  // without a stop and with the target are one
  EXPECT_EQ(comparison.only_a, std::vector<std::string>{"Mesh0/default/ALM/stop=paper"});
  EXPECT_EQ(comparison.only_b, std::vector<std::string>{"Mesh0/default/P2"});
  EXPECT_EQ(name_of(comparison.cases[1].a).text(), "Mesh0/default/ALM/study=error/tolerance=0.01");
}

TEST(Compare, OfSeveralRecordsOfACaseInARunTheLastCounts) {
  const Comparison comparison =
      compare({{record("ALM", 5), record("ALM", 1)}}, {{record("ALM", 2)}}, {});
  ASSERT_EQ(comparison.cases.size(), 1u);
  EXPECT_DOUBLE_EQ(comparison.cases[0].ratio, 2);
}

TEST(Compare, ABrokenCaseIsARegressionAndOtherChangesAreNamed) {
  Record a = record("ALM", 1), b = record("ALM", 1);
  b.status = Status::inaccurate;
  a.error_force = 1e-7;
  b.error_force = 2e-6;
  a.linear_iterations = 10;
  b.linear_iterations = 12;
  const Comparison comparison = compare({{a, record("P2", 1)}}, {{b, record("P2", 1)}}, {});
  EXPECT_TRUE(comparison.has_regression());
  for (const std::string& text : {comparison.text(), comparison.markdown()}) {
    EXPECT_TRUE(testing::contains(text, "Mesh0/default/ALM: status ok → inaccurate\n"));
    EXPECT_TRUE(testing::contains(text, "ALM: error_force 1e-07 → 2e-06\n"));
    EXPECT_TRUE(testing::contains(text, "ALM: linear_iterations 10 → 12\n"));
  }
  EXPECT_EQ(comparison.json()["regression"], true);
  // In one run of several; but not where A had failed, too.
  EXPECT_TRUE(compare({{a}, {a}}, {{b}, {a}}, {}).has_regression());
  EXPECT_FALSE(compare({{a}, {b}}, {{b}, {a}}, {}).has_regression());
}

TEST(Compare, TheGeometricMeanIsOverTheCasesThatAllRunsHave) {
  Record crashed = record("BLIND", 1);
  crashed.status = Status::crashed;
  const Comparison comparison = compare({{record("ALM", 1), record("P2", 1), crashed}},
                                        {{record("ALM", 2), record("P2", 0.5), crashed}}, {});
  EXPECT_EQ(comparison.timed, 2u);
  EXPECT_DOUBLE_EQ(comparison.mean_ratio.value_or(0), 1);
  EXPECT_FALSE(comparison.mean_interval);
  EXPECT_FALSE(compare({{crashed}}, {{crashed}}, {}).mean_ratio);
  const Comparison several = compared(interleaved(1.1));
  ASSERT_TRUE(several.mean_interval);
  EXPECT_LE(several.mean_interval->low, 1.1);
  EXPECT_GE(several.mean_interval->high, 1.1);
}

}  // namespace
}  // namespace airybench::compare_test
