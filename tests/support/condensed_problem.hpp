// The contact problem of a body, by a factor of its hybridized system.
#pragma once

#include "solvers/condensation/hybridized.hpp"
#include "solvers/condensation/stiffness_condensation.hpp"

namespace airybench::testing {

inline contact::Problem condensed(const Problem& problem, const ContactPoints& points) {
  const HybridizedSystem system = assemble_hybridized(problem, points);
  MultifrontalStiffness factor(system.K, system.n_c);
  Solution ignored;
  return factorise_and_condense(factor, system.b, points, "hybridized", {}, ignored);
}

}  // namespace airybench::testing
