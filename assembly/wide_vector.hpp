// Vectors of Wide numbers.
#pragma once

#include <Eigen/Core>

#include "support/wide.hpp"

namespace airybench {

using WideVector = Eigen::VectorX<Wide>;

}  // namespace airybench
