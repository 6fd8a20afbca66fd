// The data of a discrete problem — coordinates, compliances, signs — are doubles and exact,
// whatever scalar is computed in. A scalar that is several numbers side by side (solvers/base/
// pack.hpp) takes as many.
#pragma once

namespace airybench {

template <typename Scalar>
struct ExactData {
  using Type = double;
};
template <typename Scalar>
using Data = typename ExactData<Scalar>::Type;

}  // namespace airybench
