// 113 bits of mantissa, in software (libquadmath): the tests' yardstick. The element formulas are
// templates over the scalar, instantiated for double, long double and this.
#pragma once

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/float128.hpp>

namespace airybench {

using Quad = boost::multiprecision::float128;

}  // namespace airybench
