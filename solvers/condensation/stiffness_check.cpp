#include "solvers/condensation/stiffness_check.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/load_scale.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {

void check_stiffness_answer(const Problem& problem, const ContactPoints& contact,
                            const CondensedSystem& condensed, const UnbalancedForces& unbalanced,
                            const Eigen::VectorXd& displacement, StiffnessFactor& factor,
                            const RunControl& control, Solution& solution) {
  const LoadScale scale = load_scale(problem);
  Eigen::VectorXd delta = unbalanced.r;
  factor.cholesky.solve_in_place(delta, control.deadline);
  const double error = std::sqrt(std::max(0.0, unbalanced.r.dot(delta)));
  double estimate =
      std::max(relative_error(error, std::sqrt(stress_norm_squared(problem, solution.stress)),
                              scale.energy_norm),
               relative_error(unbalanced.r.size() > 0 ? unbalanced.r.cwiseAbs().maxCoeff() : 0,
                              unbalanced.largest, scale.force_N));
  if (solution.F_C.size() > 0) {
    const Eigen::VectorXd corrected = displacement + delta.tail(displacement.size());
    const double off = natural_map(contact, condensed.D.diagonal(), solution.F_C, corrected).norm();
    estimate = std::max(estimate, relative_error(off, solution.F_C.norm(), scale.force_N));
  }
  judge_by_own_estimate(estimate, control, solution);
}

}  // namespace airybench
