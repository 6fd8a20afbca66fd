#include "verify/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/problem/load_scale.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/condensation/iterative_refinement.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"

namespace airybench {
namespace {

// Solves for F_C, G and u to rounding; returns the relative change of F_C in the next step.
double solve_contact_to_rounding(const HybridizedSystemIn<Wide>& system, const LoadScale& scale,
                                 const Eigen::VectorXd& start, const MultifrontalFactor& factor,
                                 Reference& reference, Refined& refined) {
  constexpr int max_steps = 20;
  const Eigen::MatrixXd& D = reference.condensed.D;
  const ContactPoints& contact = reference.condensed.points;
  Eigen::VectorXd F = start;
  Refined at_F;
  double error = 0, best = std::numeric_limits<double>::infinity();
  for (int step = 0; step < max_steps && F.allFinite(); ++step) {
    refine(system, factor, F, at_F);
    const WideVector u = at_F.u.tail(system.n_c);
    const Eigen::VectorXd r = relative_to_gap(contact, u).cast<double>();
    const double residual =
        scale.relative_force(natural_map_of(contact, D.diagonal(), F, r).norm(), F.norm());
    if (!(residual < best)) break;
    const Eigen::VectorXd next = active_set_step(D, contact, F, r);
    error = next.allFinite() ? scale.relative_energy(D_norm(D, next - F), D_norm(D, F))
                             : std::numeric_limits<double>::infinity();
    reference.F_C = F;
    reference.natural_map_residual = residual;
    refined = at_F;
    if (residual == 0 || residual > best / 2) break;
    best = residual;
    F = next;
  }
  if (reference.F_C.size() == 0)
    throw Breakdown("no reference: its contact law has no finite solution");
  reference.condensed.G = times(D, reference.F_C) - refined.u.tail(system.n_c).cast<double>();
  return error;
}

}  // namespace

Reference compute_reference(const ContactSystem& given, const Eigen::VectorXd& start,
                            StartIs start_is) {
  const Problem& problem = *given.problem;
  const LoadScale scale = load_scale(problem);
  const auto system = assemble_hybridized<Wide>(problem, given.contact);
  ElementMatrices K = rounded<double>(system.K);
  MultifrontalStiffness factor(K, system.n_c);
  factor.analyse();
  factor.factor({});
  K = {};
  Reference reference;
  Refined refined;
  double force_error = 0;
  if (system.n_c > 0) {
    reference.condensed.G = factor.load(system.b.cast<double>());
    reference.condensed.D = factor.compliance();
    reference.condensed.points = given.contact;
    Eigen::VectorXd F = start;
    if (start_is == StartIs::guess) {
      ContactResult found = solve_contact(reference.condensed, {.start = start});
      F = std::move(found.F_C);
      if (found.free_motion_mm.size() > 0)
        reference.condensed.points =
            with_known_motion(reference.condensed.points, found.free_motion_mm);
      reference.free_motion_mm = std::move(found.free_motion_mm);
    }
    force_error =
        solve_contact_to_rounding(system, scale, F, factor.cholesky(), reference, refined);
  } else {
    refine(system, factor.cholesky(), {}, refined);
  }
  reference.stress = hybridized_stress(problem, system, refined.u);
  const double stress_error = scale.relative_energy(
      refined.last_correction, std::sqrt(stress_norm_squared(problem, reference.stress)));
  // The motion of a free body is that of the double-precision answer.
  reference.error_estimate = std::max({stress_error, force_error, reference.natural_map_residual,
                                       unbalanced_share(given.contact.free, reference.F_C)});
  return reference;
}

}  // namespace airybench
