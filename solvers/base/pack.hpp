// A few doubles side by side that go through a formula together: a scalar for the templates of
// equilibrium_element.hpp. Every lane is computed as a double by itself would be, in the same
// order, so that the number of lanes does not change a bit.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "assembly/elements/exact_data.hpp"

namespace airybench {

namespace pack_lanes {
template <int width>
struct Of;
template <>
struct Of<2> {
  typedef double Type __attribute__((vector_size(16)));
};
template <>
struct Of<4> {
  typedef double Type __attribute__((vector_size(32)));
};
template <>
struct Of<8> {
  typedef double Type __attribute__((vector_size(64)));
};
}  // namespace pack_lanes

template <int width>
struct Pack {
  using Lanes = typename pack_lanes::Of<width>::Type;
  Lanes lanes;

  Pack() = default;
  Pack(double all) : lanes(all - Lanes{}) {}
  explicit Pack(const Lanes& each) : lanes(each) {}

  Pack operator-() const { return Pack(-lanes); }
  Pack& operator+=(const Pack& b) { return lanes += b.lanes, *this; }
  Pack& operator-=(const Pack& b) { return lanes -= b.lanes, *this; }
  Pack& operator*=(const Pack& b) { return lanes *= b.lanes, *this; }
  Pack& operator/=(const Pack& b) { return lanes /= b.lanes, *this; }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.lanes + b.lanes); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.lanes - b.lanes); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.lanes * b.lanes); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.lanes / b.lanes); }
  // A truth per lane.
  struct Truth {
    decltype(Lanes{} < Lanes{}) lanes;
    friend bool any(const Truth& truth) {
      bool found = false;
      for (int l = 0; l < width; ++l) found |= truth.lanes[l] != 0;
      return found;
    }
    friend bool all(const Truth& truth) { return !any(Truth{~truth.lanes}); }
    friend Pack select(const Truth& truth, const Pack& a, const Pack& b) {
      return Pack(truth.lanes ? a.lanes : b.lanes);
    }
  };
  friend Truth operator<(const Pack& a, const Pack& b) { return {a.lanes < b.lanes}; }
  friend Pack min(const Pack& a, const Pack& b) { return select(b < a, b, a); }
  friend Pack sqrt(const Pack& a) {
    Pack root;
    for (int l = 0; l < width; ++l) root.lanes[l] = std::sqrt(a.lanes[l]);
    return root;
  }
};

template <int width>
struct ExactData<Pack<width>> {
  using Type = Pack<width>;
};
template <int width>
struct ConstantOf<Pack<width>> {
  using Type = double;
};

}  // namespace airybench

template <int width>
struct Eigen::NumTraits<airybench::Pack<width>> : Eigen::NumTraits<double> {
  using Real = airybench::Pack<width>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
};
