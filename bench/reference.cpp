#include "bench/reference.hpp"

#include <sstream>

#include "solvers/condensation/hybridized.hpp"
#include "solvers/contact/gauss_seidel.hpp"

namespace airybench {

Reference compute_reference(const DualSystem& airy) {
  constexpr double aim = 1e-14, at_least = 1e-10;
  const Problem& problem = *airy.problem;
  const HybridizedSystem system = assemble_hybridized(problem, airy.contact);
  StiffnessFactor factor;
  factor.cholesky.analyse(system.K, system.n_c);
  factor.cholesky.factor(system.K);
  factor.y = factor.cholesky.forward(system.b);

  Reference reference;
  Eigen::VectorXd displacement;
  if (airy.contact.size() > 0) {
    reference.condensed = condense(factor);
    RunControl control;
    control.contact_tolerance = aim;
    ContactResult contact =
        solve_contact_by_gauss_seidel(reference.condensed, airy.contact, control);
    if (!(contact.natural_map_residual <= at_least)) {
      std::ostringstream message;
      message << "no reference: its contact law stands at a natural map residual of "
              << contact.natural_map_residual << " after " << contact.sweeps << " sweeps";
      throw Breakdown(message.str());
    }
    reference.natural_map_residual = contact.natural_map_residual;
    reference.F_C = std::move(contact.F_C);
    displacement = reference.condensed.D * reference.F_C - reference.condensed.G;
  }
  reference.stress = hybridized_stress(problem, system, factor, displacement);
  return reference;
}

}  // namespace airybench
