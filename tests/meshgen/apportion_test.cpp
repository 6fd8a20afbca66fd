#include "meshgen/apportion.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace airybench::apportion_test {
namespace {

using Counts = std::vector<int>;

TEST(Apportion, LargestRemaindersGetTheRestAndSmallSegmentsOneFirst) {
  struct Case {
    std::vector<double> weights;
    int total;
    Counts counts;
  };
  for (const auto& [weights, total, counts] :
       {Case{{1, 2, 3}, 12, {2, 4, 6}},            // exact shares
        Case{{2.6, 3.3, 4.1}, 10, {3, 3, 4}},      // shares 2.6, 3.3, 4.1
        Case{{1, 1, 1, 1}, 50, {13, 13, 12, 12}},  // equal remainders go to the earlier
        Case{{1, 1 + 1e-15, 1, 1 + 1e-15}, 50, {13, 13, 12, 12}},  // equal but for rounding
        Case{{0.001, 10, 0.001, 10}, 6, {1, 2, 1, 2}}, Case{{1e-12, 1}, 2, {1, 1}}})
    EXPECT_EQ(apportion(weights, total), counts) << weights.front() << " … in " << total;
}

TEST(Apportion, SumIsTheTotalAndNobodyIsLeftOut) {
  const std::vector<double> weights = {0.3, 7.1, 2.9, 0.05, 4.4, 1.25, 1.25};
  for (int total = 7; total < 300; ++total) {
    const Counts counts = apportion(weights, total);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), total);
    for (const int count : counts) EXPECT_GE(count, 1) << total;
  }
}

TEST(Apportion, WithinOneOfTheShareWhenAllSharesExceedOne) {
  const std::vector<double> weights = {3.7, 7.1, 2.9, 5.3};
  const double sum = 19;
  const Counts counts = apportion(weights, 77);
  for (std::size_t i = 0; i < weights.size(); ++i)
    EXPECT_LT(std::abs(counts[i] - 77 * weights[i] / sum), 1);
}

TEST(Apportion, RefusesTooFewEdgesAndBadWeights) {
  EXPECT_THROW(apportion({1, 1, 1}, 2), std::invalid_argument);
  EXPECT_THROW(apportion({1, 0}, 5), std::invalid_argument);
  EXPECT_THROW(apportion({1, -1}, 5), std::invalid_argument);
}

}  // namespace
}  // namespace airybench::apportion_test
