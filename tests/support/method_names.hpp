// Methods as the parameters of tests.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "solvers/base/method.hpp"

namespace airybench::testing {

// "SYMMLQ_SKY_schur_sparse": what the name of a test may be made of.
inline std::string readable(const ::testing::TestParamInfo<Method>& info) {
  std::string name = info.param.name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
}

}  // namespace airybench::testing
