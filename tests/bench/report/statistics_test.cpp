// The statistics behind comparisons and predictions, against published tables and figures
// worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "bench/records/robust.hpp"
#include "bench/records/summary.hpp"
#include "bench/report/statistics.hpp"

namespace airybench::statistics_test {
namespace {

// Samples of m and n different values with U = u.
std::pair<std::vector<double>, std::vector<double>> samples_with(int m, int n, int u) {
  std::vector<double> a(m), b;
  std::iota(a.begin(), a.end(), 1.0);
  for (int j = 0; j < n; ++j) {  // the j-th of b is above as many of a as are still needed
    const int above = std::min(m, u);
    u -= above;
    b.push_back(above + 0.5 + 0.001 * j);
  }
  return {a, b};
}

TEST(Robust, MedianAndItsDeviation) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median_absolute_deviation({1, 2, 3, 4, 100}), 1);
  EXPECT_NEAR(robust_standard_deviation({1, 2, 3, 4, 100}), 1.482602, 1e-6);
}

TEST(Robust, TimesTieWhoseIntervalsOverlap) {
  const auto timed = [](std::vector<double> samples_s) {
    Record r;
    r.samples_s = std::move(samples_s);
    summarise(r);
    return r;
  };
  const Record fast = timed({1, 1.1, 1.2}), like_it = timed({1.15, 1.3, 1.4}),
               slow = timed({2, 2.1, 2.2});
  EXPECT_TRUE(times_tie(fast, like_it));
  EXPECT_TRUE(times_tie(like_it, fast));
  EXPECT_FALSE(times_tie(fast, slow));
  EXPECT_FALSE(times_tie(slow, fast));
  EXPECT_FALSE(times_tie(fast, timed({1})));  // not known
  EXPECT_TRUE(has_few_samples(timed({1, 1, 1, 1})));
  EXPECT_FALSE(has_few_samples(timed({1, 1, 1, 1, 1})));
}

// Le Boudec, Tab. A.1, where it is symmetric: ranks j and k of n sorted samples.
TEST(MedianInterval, HasTheRanksOfThePublishedTable) {
  for (const auto& [n, j, k] : std::vector<std::array<int, 3>>{
           {6, 1, 6}, {9, 2, 8}, {12, 3, 10}, {20, 6, 15}, {30, 10, 21}, {70, 27, 44}}) {
    std::vector<double> samples(n);
    std::iota(samples.begin(), samples.end(), 1.0);
    std::shuffle(samples.begin(), samples.end(), std::mt19937(1));
    const std::optional<Interval> interval = median_interval(samples);
    ASSERT_TRUE(interval) << n;
    EXPECT_EQ(interval->low, j) << n;
    EXPECT_EQ(interval->high, k) << n;
  }
}

// Of any number of samples: P(B <= j - 1) is at most 2.5 %, P(B <= j) more.
TEST(MedianInterval, IsTheNarrowestThatHolds) {
  EXPECT_FALSE(median_interval({}));
  EXPECT_FALSE(median_interval({1, 2, 3, 4, 5}));
  for (int n = 6; n <= 1000; ++n) {
    std::vector<double> samples(n);
    std::iota(samples.begin(), samples.end(), 1.0);
    const Interval interval = *median_interval(samples);
    double of_outcome = std::pow(0.5, n), below = 0;  // P(B = i), P(B <= i)
    for (int i = 0; i < interval.low; ++i) {
      below += of_outcome;
      of_outcome *= static_cast<double>(n - i) / (i + 1);
    }
    EXPECT_LE(below, 0.025) << n;
    EXPECT_GT(below + of_outcome, 0.025) << n;
    EXPECT_EQ(interval.high, n + 1 - interval.low) << n;
  }
}

TEST(MedianInterval, UncertaintyIsOfTheFartherEnd) {
  EXPECT_FALSE(median_uncertainty({1, 1, 1, 1, 1}));
  EXPECT_EQ(*median_uncertainty({1, 1, 1, 1, 1, 1}), 0);
  EXPECT_DOUBLE_EQ(*median_uncertainty({0.9, 1, 1, 1, 1, 1.5}), 0.5);
  EXPECT_DOUBLE_EQ(*median_uncertainty({0.6, 1, 1, 1, 1, 1.1}), 0.4);
}

// Mann and Whitney's Tab. I (one tail there), and counts by hand: of C(6, 3) = 20 orderings one has
// U = 0 and one U = 1, and so on.
TEST(MannWhitney, ExactPOfThePublishedTable) {
  struct Entry {
    int m, n, u;
    double p;  // two-sided
  };
  for (const auto& [m, n, u, p] :
       {Entry{3, 3, 0, 2.0 / 20}, Entry{3, 3, 1, 4.0 / 20}, Entry{3, 3, 2, 8.0 / 20},
        Entry{4, 4, 0, 2.0 / 70}, Entry{4, 4, 1, 4.0 / 70}, Entry{4, 4, 2, 8.0 / 70},
        Entry{5, 5, 2, 8.0 / 252}, Entry{5, 5, 3, 14.0 / 252}, Entry{3, 4, 0, 2.0 / 35},
        Entry{2, 5, 0, 2.0 / 21}, Entry{9, 9, 0, 2.0 / 48620}, Entry{3, 3, 9, 2.0 / 20}}) {
    const auto [a, b] = samples_with(m, n, u);
    const MannWhitney forward = mann_whitney(a, b), backward = mann_whitney(b, a);
    EXPECT_TRUE(forward.exact);
    EXPECT_EQ(forward.u, u);
    EXPECT_EQ(backward.u, m * n - u);
    EXPECT_NEAR(forward.p, p, 1e-12) << m << " " << n << " " << u;
    EXPECT_NEAR(backward.p, p, 1e-12) << m << " " << n << " " << u;
  }
}

// The tabulated critical values of the two-sided test at 5 %: the largest U that rejects.
TEST(MannWhitney, CriticalValuesAtFivePercent) {
  for (const auto& [n, critical] :
       {std::pair(4, 0), std::pair(5, 2), std::pair(6, 5), std::pair(7, 8), std::pair(8, 13),
        std::pair(9, 17), std::pair(10, 23), std::pair(15, 64), std::pair(20, 127)}) {
    const auto [a, b] = samples_with(n, n, critical);
    EXPECT_LE(mann_whitney(a, b).p, 0.05) << n;
    const auto [c, d] = samples_with(n, n, critical + 1);
    EXPECT_GT(mann_whitney(c, d).p, 0.05) << n;
  }
}

TEST(MannWhitney, TiesAreTakenAsNormalWithTheirCorrection) {
  // U = 15.5 of 16; two ties of two: Var = 16/12 (9 - 12/56).
  const MannWhitney test = mann_whitney({1, 2, 2, 4}, {4, 5, 6, 7});
  EXPECT_FALSE(test.exact);
  EXPECT_EQ(test.u, 15.5);
  const double z = (15.5 - 8 - 0.5) / std::sqrt(16.0 / 12 * (9 - 12.0 / 56));
  EXPECT_NEAR(test.p, std::erfc(z / std::sqrt(2)), 1e-14);
  EXPECT_EQ(mann_whitney({1, 1, 1}, {1, 1}).p, 1);
  EXPECT_EQ(mann_whitney({}, {}).p, 1);
  EXPECT_EQ(mann_whitney({}, {1, 2}).p, 1);
  EXPECT_EQ(mann_whitney({1, 1}, {1}).p, 1);
}

// Against SciPy 1.10, mannwhitneyu(method='exact' and 'asymptotic').
TEST(MannWhitney, AgreesWithAnotherImplementation) {
  const auto [a, b] = samples_with(25, 25, 180);
  const MannWhitney exact = mann_whitney(a, b);
  EXPECT_TRUE(exact.exact);
  EXPECT_NEAR(exact.p, 0.009568647391321777, 1e-14);
  const auto [c, d] = samples_with(26, 26, 200);
  const MannWhitney approximate = mann_whitney(c, d);
  EXPECT_FALSE(approximate.exact);
  EXPECT_NEAR(approximate.p, 0.011855593554954125, 1e-14);
  const MannWhitney uneven =
      mann_whitney({1.1, 2.2, 3.3, 4.4, 5.5, 6.6, 7.7}, {2, 3, 5, 8, 9, 10.5, 11, 12.25});
  EXPECT_NEAR(uneven.p, 0.1205905205905206, 1e-14);
}

TEST(MannWhitney, HowManyValuesALevelNeeds) {
  EXPECT_DOUBLE_EQ(min_mann_whitney_p(5, 5), 2.0 / 252);
  EXPECT_DOUBLE_EQ(min_mann_whitney_p(1, 1), 1);
  EXPECT_DOUBLE_EQ(min_mann_whitney_p(0, 3), 1);
  EXPECT_EQ(values_needed_for(0.05), 4u);
  EXPECT_EQ(values_needed_for(0.05 / 24), 7u);
  EXPECT_EQ(values_needed_for(1), 1u);
}

TEST(Holm, StepsDownInTheOrderOfP) {
  const std::vector<double> adjusted = holm_adjusted({0.01, 0.04, 0.03, 0.005});
  EXPECT_DOUBLE_EQ(adjusted[3], 0.02);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);  // 0.04 itself, but never below one before it
  EXPECT_TRUE(holm_adjusted({}).empty());
  EXPECT_EQ(holm_adjusted({0.9, 0.8})[0], 1);
}

TEST(Bootstrap, IsInsideTheSamplesAndRepeatable) {
  const std::vector<double> samples = {2, 2.1, 1.9, 2.2, 1.8};
  const Interval interval = bootstrap_median(samples);
  EXPECT_GE(interval.low, 1.8);
  EXPECT_LE(interval.high, 2.2);
  EXPECT_LT(interval.low, 2);
  EXPECT_GT(interval.high, 2);
  EXPECT_EQ(bootstrap_median(samples).low, interval.low);
  EXPECT_EQ(bootstrap_median({3}).low, 3);
}

// Of a normal sample: 95 % nominal; the percentile bootstrap of 9 values covers nearly that.
TEST(Bootstrap, CoversTheMedian) {
  std::mt19937 engine(5);
  const auto normal = [&engine] {  // sum of uniforms: the engine's own numbers alone
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += engine() / 4294967296.0;
    return sum;
  };
  int covered = 0;
  constexpr int trials = 200;
  for (int t = 0; t < trials; ++t) {
    std::vector<double> samples(9);
    for (double& x : samples) x = normal();
    const Interval interval = bootstrap_median(samples);
    covered += interval.low <= 0 && 0 <= interval.high;
  }
  EXPECT_GT(covered, trials * 0.88);
}

}  // namespace
}  // namespace airybench::statistics_test
