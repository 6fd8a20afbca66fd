#include "bench/report/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace airybench::power_law_test {
namespace {

std::vector<SizedValue> on_a_law(double factor, double exponent, const std::vector<int>& sizes) {
  std::vector<SizedValue> points;
  for (const int n : sizes) points.push_back({n, factor * std::pow(n, exponent)});
  return points;
}

TEST(PowerLaw, IsExactOnPointsThatFollowOne) {
  const auto law = extrapolate(on_a_law(3e-7, 1.7, {100, 300, 1000, 2000}), 9000, 0.1);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->value / (3e-7 * std::pow(9000, 1.7)), 1, 1e-12);
  EXPECT_NEAR(law->low * law->high / (law->value * law->value), 1, 1e-12);
}

TEST(PowerLaw, TheNearestSizesDecide) {
  // Linear up to 1000, quadratic from there.
  const std::vector<SizedValue> bent = {{10, 10}, {100, 100}, {1000, 1000}, {2000, 4000}};
  const auto above = extrapolate(bent, 4000, 0.1), below = extrapolate(bent, 30, 0.1);
  EXPECT_GT(above->value, 6500);  // the straight line through all of them is at 5600
  EXPECT_NEAR(below->value, 30, 5);
}

TEST(PowerLaw, TheIntervalGrowsWithScatterAndDistance) {
  auto points = on_a_law(1, 1.5, {100, 200, 400, 800});
  const auto width = [&](int n) {
    const auto law = extrapolate(points, n, 0.05);
    return law->high / law->low;
  };
  const double near = width(1000), far = width(10000);
  EXPECT_GT(near, std::exp(4 * 0.05));
  EXPECT_GT(far, 1.5 * near);
  points[1].value *= 2;
  points[2].value /= 2;
  EXPECT_GT(width(1000), 4 * near);
}

TEST(PowerLaw, OneSizeAloneNeedsAnExponent) {
  const std::vector<SizedValue> one = {{100, 5}, {100, 5}};
  EXPECT_FALSE(extrapolate(one, 200, 0.1));
  EXPECT_FALSE(extrapolate({}, 200, 0.1));
  EXPECT_NEAR(extrapolate(one, 200, 2, 0.1).value, 20, 1e-12);
  const auto here = extrapolate(one, 100, 2, 0.1), there = extrapolate(one, 1000, 2, 0.1);
  EXPECT_LT(here.high / here.low, std::exp(4 * 0.15));
  EXPECT_GT(there.high / there.low, std::exp(4 * exponent_scatter * std::log(10)));
}

TEST(PowerLaw, MethodsShareAnExponentWhateverTheirFactors) {
  const auto exponent = pooled_exponent(
      {on_a_law(1, 1.5, {100, 400}), on_a_law(50, 1.5, {200, 1600, 3000}), {{100, 9}}, {}}, 500);
  ASSERT_TRUE(exponent);
  EXPECT_NEAR(*exponent, 1.5, 1e-12);
  EXPECT_FALSE(pooled_exponent({{{100, 9}}, {}}, 500));
}

}  // namespace
}  // namespace airybench::power_law_test
