// The data of a discrete problem (coordinates, compliances, signs) are exact doubles for every
// scalar of computation. A scalar that packs several numbers (solvers/base/pack.hpp) has as many;
// what is the same for all of them is a single number, and what is true of some is asked per
// number.
#pragma once

namespace airybench {

template <typename Scalar>
struct ExactData {
  using Type = double;
};
template <typename Scalar>
using Data = typename ExactData<Scalar>::Type;

template <typename Scalar>
struct ConstantOf {
  using Type = Scalar;
};
template <typename Scalar>
using Constant = typename ConstantOf<Scalar>::Type;

inline bool any(bool truth) { return truth; }
inline bool all(bool truth) { return truth; }
template <typename Scalar>
Scalar select(bool truth, const Scalar& a, const Scalar& b) {
  return truth ? a : b;
}

}  // namespace airybench
