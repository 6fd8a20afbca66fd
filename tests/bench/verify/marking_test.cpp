#include "bench/verify/marking.hpp"

#include <gtest/gtest.h>

namespace airybench::marking_test {
namespace {

TEST(BulkMarks, AreTheFewestThatHoldTheFraction) {
  const std::vector<double> parts = {1, 5, 0, 3, 1};
  EXPECT_EQ(bulk_marks(parts, 0.5), (std::vector{1}));
  EXPECT_EQ(bulk_marks(parts, 0.51), (std::vector{1, 3}));
  EXPECT_EQ(bulk_marks(parts, 0.85), (std::vector{0, 1, 3}));  // of equal parts the lower number
  EXPECT_EQ(bulk_marks(parts, 1), (std::vector{0, 1, 3, 4}));
}

TEST(BulkMarks, PartsThatRoundingMadeNegativeAreZero) {
  EXPECT_EQ(bulk_marks({-1e-18, 1, 1}, 1), (std::vector{1, 2}));
  EXPECT_EQ(bulk_marks({0, -1e-18}, 0.6), std::vector<int>());
}

}  // namespace
}  // namespace airybench::marking_test
