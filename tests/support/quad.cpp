#include "tests/support/quad.hpp"

#include "assembly/elements/curved_element_templates.hpp"
#include "assembly/elements/equilibrium_element_templates.hpp"
#include "assembly/elements/reference_element_templates.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "solvers/condensation/hybridized_templates.hpp"

namespace airybench {

template HybridizedSystemIn<Quad> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<Quad>&,
                                       const Eigen::VectorX<Quad>&);

}  // namespace airybench
