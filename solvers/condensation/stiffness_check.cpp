#include "solvers/condensation/stiffness_check.hpp"

#include <cmath>

#include "assembly/problem/load_scale.hpp"
#include "solvers/contact/active_set.hpp"

namespace airybench {

void check_stiffness_answer(const Problem& problem, const contact::Problem& condensed,
                            const UnbalancedForces& unbalanced, const Eigen::VectorXd& displacement,
                            StiffnessFactor& factor, const RunControl& control,
                            Solution& solution) {
  const LoadScale scale = load_scale(problem);
  const Eigen::VectorXd& r = unbalanced.r;
  Eigen::VectorXd load = r;
  if (unbalanced.defect.size() > 0) load += unbalanced.defect;
  Eigen::VectorXd delta = load;
  factor.solve_in_place(delta, control.deadline);
  // e² + δ·(r − d), d the defect; a hundredth of e besides, as far as K's factor may be wrong.
  const double squared = unbalanced.defect_energy + delta.dot(load) -
                         (unbalanced.defect.size() > 0 ? 2 * delta.dot(unbalanced.defect) : 0);
  double error =
      (squared < 0 ? 0 : std::sqrt(squared)) + 0.01 * std::sqrt(unbalanced.defect_energy);
  double estimate = scale.relative_force(r.lpNorm<Eigen::Infinity>(), unbalanced.largest);
  if (solution.F_C.size() > 0) {
    const ContactCheck check = check_contact(condensed.D, condensed.points, solution.F_C,
                                             displacement + delta.tail(displacement.size()), scale);
    error += check.energy_norm;
    estimate = larger_error(estimate, check.relative);
  }
  estimate = larger_error(
      estimate,
      scale.relative_energy(error, std::sqrt(stress_norm_squared(problem, solution.stress))));
  judge_by_own_estimate(estimate, control, solution);
}

}  // namespace airybench
