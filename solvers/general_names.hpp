// Methods made from general names: a family, a preconditioner or parameters, options.
#pragma once

#include <string>

#include "solvers/method.hpp"

namespace airybench {

// "3STEPCG:DTIC3", "SYMMLQ:SSOR0.7,schur=sparse", "ALM:r=20,rho=32". Throws std::invalid_argument
// naming what is wrong and what is valid.
Method method_of_general_name(const std::string& name);

// Whether the name is of one of these families.
bool is_general_name(const std::string& name);

}  // namespace airybench
