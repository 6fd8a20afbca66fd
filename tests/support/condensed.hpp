// D and G of a problem, by a factor of the hybridized system.
#pragma once

#include "solvers/condensation/hybridized.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench::testing {

inline CondensedSystem condensed(const HybridizedSystem& system) {
  StiffnessFactor factor;
  Solution ignored;
  return factorise_and_condense(system.K, system.b, system.n_c, "hybridized", {}, factor, ignored);
}

}  // namespace airybench::testing
