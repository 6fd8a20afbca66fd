// The data of a discrete problem (coordinates, compliances, signs) are exact doubles for every
// scalar of computation. A scalar that packs several numbers (solvers/base/pack.hpp) has as many.
#pragma once

namespace airybench {

template <typename Scalar>
struct ExactData {
  using Type = double;
};
template <typename Scalar>
using Data = typename ExactData<Scalar>::Type;

}  // namespace airybench
