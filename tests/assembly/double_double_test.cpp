#include "support/double_double.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdint>
#include <random>

namespace airybench {
namespace {

__extension__ typedef __int128 Whole;

Whole whole(const DoubleDouble& a) {
  return static_cast<Whole>(a.high()) + static_cast<Whole>(a.low());
}
DoubleDouble number(Whole a) {
  const auto high = static_cast<double>(a);
  return DoubleDouble(high) + static_cast<double>(a - static_cast<Whole>(high));
}

class Dice {
 public:
  // Of at most so many bits.
  Whole operator()(int bits) {
    const Whole value = static_cast<Whole>(random_()) << 64 | random_();
    return value % (static_cast<Whole>(1) << bits);
  }

 private:
  std::mt19937_64 random_{1};
};

constexpr int samples = 10000;
const DoubleDouble rounding = 8 * std::numeric_limits<DoubleDouble>::epsilon();

TEST(DoubleDouble, SumsAndProductsOfWholeNumbersAreExactWhereTheyFit) {
  Dice dice;
  for (int i = 0; i < samples; ++i) {
    const Whole a = dice(1 + i % 104), b = dice(1 + i * 7 % 104);
    EXPECT_TRUE(whole(number(a)) == a);
    EXPECT_TRUE(whole(number(a) + number(b)) == a + b);
    EXPECT_TRUE(whole(number(a) - number(b)) == a - b);
    const Whole c = dice(1 + i % 52), d = dice(1 + i * 7 % 52);
    EXPECT_TRUE(whole(number(c) * number(d)) == c * d);
    EXPECT_EQ(number(a) < number(b), a < b);
    EXPECT_EQ(number(a) == number(b), a == b);
  }
}

TEST(DoubleDouble, QuotientsAndRootsAreWhatTheirProductsSay) {
  Dice dice;
  for (int i = 0; i < samples; ++i) {
    const DoubleDouble a = number(dice(104)), b = number(dice(104) + 1);
    EXPECT_LT(abs(a / b * b - a), rounding * abs(a));
    const DoubleDouble root = sqrt(abs(a));
    EXPECT_LT(abs(root * root - abs(a)), rounding * abs(a));
  }
  // √2 = 1.4142135623730950488016887242096980785696718753769…
  EXPECT_EQ(sqrt(DoubleDouble(2)).high(), 1.4142135623730951);
  EXPECT_NEAR(sqrt(DoubleDouble(2)).low(), -9.667293313452913e-17, 1e-31);
  EXPECT_EQ(sqrt(DoubleDouble(0)), DoubleDouble(0));
}

TEST(DoubleDouble, TakesWholeNumbersOf64Bits) {
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{-7}, INT64_MAX - 1, INT64_MIN + 1})
    EXPECT_TRUE(whole(DoubleDouble(value)) == value);
  EXPECT_EQ(static_cast<double>(DoubleDouble(1) / 3), 1. / 3);
}

TEST(DoubleDouble, WhatIsNoNumberStaysSo) {
  const DoubleDouble nan = std::numeric_limits<DoubleDouble>::quiet_NaN();
  for (const DoubleDouble& value :
       {nan + 1, nan * 0, 1 / nan, sqrt(nan), sqrt(DoubleDouble(-1)), DoubleDouble(1) / 0})
    EXPECT_FALSE(isfinite(value) && value == value);
  EXPECT_FALSE(nan < 0 || nan > 0 || nan == nan);
}

TEST(DoubleDouble, IsAScalarOfEigen) {
  constexpr int n = 10;
  Eigen::MatrixX<DoubleDouble> hilbert(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) hilbert(i, j) = DoubleDouble(1) / (i + j + 1);
  const Eigen::VectorX<DoubleDouble> ones = Eigen::VectorX<DoubleDouble>::Ones(n),
                                     x = hilbert.llt().solve(hilbert * ones);
  EXPECT_LT(static_cast<double>((x - ones).norm()), 1e-17);  // of a condition of 1.6e13
}

}  // namespace
}  // namespace airybench
