// A number as the sum of two doubles, high + low, |low| ≤ ulp(high)/2: about 106 bits of mantissa
// with the exponents of double, in a few operations of double each. With u = 2⁻⁵³ the relative
// errors are at most 3 u² of a sum, 5 u² of a product, and about 15 u² of a quotient. (Joldes,
// Muller & Popescu, Tight and rigorous error bounds for basic building blocks of double-word
// arithmetic, ACM TOMS 44, 2017, doi:10.1145/3121432: algorithms 6, 10, and 17 with a shorter
// product than its proof has; the product's bound is that of Muller & Rideau 2022,
// doi:10.1145/3484514.)
//
// A compiler may fuse what is here: the products whose rounding is taken away are used otherwise,
// too, and stay. Infinities become NaN.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>

namespace airybench {

class DoubleDouble {
 public:
  DoubleDouble() = default;
  DoubleDouble(double value) : high_(value), low_(0) {}
  DoubleDouble(std::integral auto value) : high_(static_cast<double>(value)), low_(0) {
    if constexpr (sizeof(value) > sizeof(int)) {  // more bits than a double has
      constexpr auto part = std::int64_t{1} << 32;
      *this =
          ordered_sum(static_cast<double>(value / part * part), static_cast<double>(value % part));
    }
  }
  template <std::floating_point Number>
  explicit operator Number() const {
    return static_cast<Number>(high_) + static_cast<Number>(low_);
  }
  double high() const { return high_; }
  double low() const { return low_; }

  DoubleDouble operator-() const { return {-high_, -low_}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = sum(a.high_, b.high_), low = sum(a.low_, b.low_);
    const DoubleDouble first = ordered_sum(high.high_, high.low_ + low.high_);
    return ordered_sum(first.high_, first.low_ + low.low_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = product(a.high_, b.high_);
    return ordered_sum(high.high_, high.low_ + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double quotient = a.high_ / b.high_;
    const DoubleDouble whole = product(b.high_, quotient),
                       times = ordered_sum(whole.high_, whole.low_ + b.low_ * quotient);
    return ordered_sum(quotient, ((a.high_ - times.high_) + (a.low_ - times.low_)) / b.high_);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  friend bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
  friend std::partial_ordering operator<=>(const DoubleDouble&, const DoubleDouble&) = default;

  friend DoubleDouble abs(const DoubleDouble& a) { return a.high_ < 0 ? -a : a; }
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    const double root = std::sqrt(a.high_);
    if (root == 0) return root;
    const DoubleDouble square = product(root, root);
    return ordered_sum(root, ((a.high_ - square.high_) - square.low_ + a.low_) / (2 * root));
  }
  friend bool isfinite(const DoubleDouble& a) { return std::isfinite(a.high_); }
  friend bool isnan(const DoubleDouble& a) { return std::isnan(a.high_); }
  friend bool isinf(const DoubleDouble& a) { return std::isinf(a.high_); }

 private:
  DoubleDouble(double high, double low) : high_(high), low_(low) {}

  // a + b and a · b without error.
  static DoubleDouble ordered_sum(double a, double b) {  // |a| ≥ |b|, or a = 0
    const double s = a + b;
    return {s, b - (s - a)};
  }
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
  }
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
#ifdef __FP_FAST_FMA
    return {p, std::fma(a, b, -p)};
#else
    const auto [a1, a2] = halves(a);
    const auto [b1, b2] = halves(b);
    return {p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
#endif
  }
  struct Halves {
    double high, low;
  };
  static Halves halves(double a) {  // of 26 bits each
    constexpr double shift = (1 << 27) + 1;
    const double shifted = shift * a, high = shifted - (shifted - a);
    return {high, a - high};
  }

  double high_, low_;
};

}  // namespace airybench

template <>
class std::numeric_limits<airybench::DoubleDouble> : public std::numeric_limits<double> {
  using Number = airybench::DoubleDouble;
  using Double = std::numeric_limits<double>;

 public:
  static constexpr int digits = 2 * Double::digits - 2, digits10 = 31, max_digits10 = 33;
  static Number epsilon() { return Double::epsilon() * Double::epsilon() * 2; }
  static Number min() { return Double::min() / Double::epsilon(); }
  static Number max() { return Double::max(); }
  static Number lowest() { return Double::lowest(); }
  static Number infinity() { return Double::infinity(); }
  static Number quiet_NaN() { return Double::quiet_NaN(); }
};

template <>
struct Eigen::NumTraits<airybench::DoubleDouble>
    : Eigen::GenericNumTraits<airybench::DoubleDouble> {
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 20
  };
  static airybench::DoubleDouble dummy_precision() { return 1e-26; }
  static int digits10() { return std::numeric_limits<airybench::DoubleDouble>::digits10; }
};
