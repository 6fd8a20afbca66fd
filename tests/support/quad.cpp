#include "tests/support/quad.hpp"

#include "assembly/edge_forces_templates.hpp"
#include "assembly/hct_templates.hpp"
#include "assembly/stress_field_templates.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "solvers/condensation/hybridized_templates.hpp"

namespace airybench {

// In 128 bits there is degree 1 only.
template <>
const DegreeKernels<Quad>& degree_kernels(int) {
  throw std::logic_error("128 bits: degree 1 only");
}
template <>
DegreeInput<Quad> degree_input(const Problem&, const std::vector<int>&, int, int) {
  throw std::logic_error("128 bits: degree 1 only");
}

template HybridizedSystemIn<Quad> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<Quad>&,
                                       const Eigen::VectorX<Quad>&);

}  // namespace airybench
