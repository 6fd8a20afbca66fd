// Random numbers that a seed gives everywhere, unlike the standard library's distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace airybench::testing {

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int below(int count) { return static_cast<int>(unit() * count); }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  double sign() { return below(2) == 0 ? 1 : -1; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace airybench::testing
