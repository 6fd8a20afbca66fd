// 113 bits of mantissa, in software (libquadmath): the yardstick of the hybridized system, whose
// templates are instantiated for it in quad.cpp.
#pragma once

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/float128.hpp>

namespace airybench {

using Quad = boost::multiprecision::float128;

}  // namespace airybench
