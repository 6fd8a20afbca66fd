// D and G of a problem, by a factor of the hybridized system.
#pragma once

#include "solvers/condensation/hybridized.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench::testing {

inline CondensedSystem condensed(const HybridizedSystem& system) {
  MultifrontalStiffness factor(system.K, system.n_c);
  Solution ignored;
  return factorise_and_condense(factor, system.b, "hybridized", {}, ignored);
}

}  // namespace airybench::testing
