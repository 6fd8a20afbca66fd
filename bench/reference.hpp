// The answer against which every method's error is measured: the hybridized solution of the same
// discrete problem, with the contact law solved to rounding.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/stress_field.hpp"
#include "solvers/condensation/condensed.hpp"

namespace airybench {

struct Reference {
  CondensedSystem condensed;
  Eigen::VectorXd F_C;              // N
  StressField stress;               // MPa
  double natural_map_residual = 0;  // what the contact law was solved to, relative
};

// Throws Breakdown when there is none: the factorisation failed, or the contact sweeps stayed above
// 1e-10.
Reference compute_reference(const DualSystem& system);

}  // namespace airybench
