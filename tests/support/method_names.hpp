// Methods as the parameters of tests.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "solvers/methods.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench {

inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace testing {

// "SYMMLQ_SKY_schur_sparse": what the name of a test may be made of.
inline std::string readable_name(std::string name) {
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
}
inline std::string readable(const ::testing::TestParamInfo<Method>& info) {
  return readable_name(info.param.name);
}

// "HYBRID,HYBRID:k=2,…": by stresses of every degree.
inline std::string hybrid_of_every_degree() {
  std::string names = hybrid_of_degree(1);
  for (int k = 2; k <= highest_degree; ++k) names += "," + hybrid_of_degree(k);
  return names;
}

// Each kind of method once, the preconditioned ones with one preconditioner of every kind; but
// those in displacements.
inline std::vector<Method> kinds_of_methods() {
  std::vector<Method> kinds;
  for (const Method& method : methods())
    if (!method.is_iterative() && !method.in_displacements()) kinds.push_back(method);
  const auto add = [&](const std::string& names) {
    for (const Method& method : select_methods(names)) kinds.push_back(method);
  };
  add("HYBRID:CG,ALM:r=20,rho=20,ALM:AUTO,SYMMLQ:DTIC3,"
      "SYMMLQ:FLIC2,SYMMLQ:SKY,3STEPCG:DTIC3,3STEPCG:FLIC2,3STEPCG:SKY");
  if (!sanitized)  // thousands of iterations; preconditioners_test has these, too
    add("SYMMLQ:SSOR1.0,SYMMLQ:NONE,3STEPCG:SSOR1.0,3STEPCG:NONE");
  return kinds;
}

}  // namespace testing
}  // namespace airybench
