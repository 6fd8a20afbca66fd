#include "solvers/contact/proximal_points.hpp"

#include <algorithm>

#include "solvers/contact/active_set.hpp"
#include "solvers/contact/compliance.hpp"

namespace airybench {

void finish_by_proximal_points(const contact::Problem& problem, const ContactOptions& options,
                               const Deadline& deadline, ContactResult& result) {
  constexpr int patience = 60;  // points without a natural map half as large
  constexpr ActiveSetLimits few = {.max_steps = 12, .patience = 3};
  const double mean = D_diagonal(problem).mean();
  contact::Problem shifted = problem;
  double s = 0, next_s = 0.01, to_halve = result.natural_map_residual;
  Eigen::VectorXd F = result.F_C;
  for (int since_halved = 0, ended = 0;
       result.natural_map_residual > options.tolerance && since_halved <= patience;
       ++since_halved) {
    deadline.check("the proximal points of the contact law");
    for (Eigen::Index i = 0; i < F.size(); ++i)
      (problem.is_dense() ? shifted.D(i, i) : shifted.rows.coeffRef(i, i)) += (next_s - s) * mean;
    s = next_s;
    shifted.G = problem.G + s * mean * F;
    ContactOptions inner;
    inner.tolerance = std::max(1e-14, 1e-3 * relative_natural_map(shifted, F));
    inner.acceptable = inner.tolerance;
    ContactResult point;
    point.F_C = F;
    finish_by_active_set(shifted, inner, deadline, point, few);
    result.active_set_steps += point.active_set_steps;
    if (!point.converged) {
      next_s = std::min(1.0, 3 * s);
      ended = 0;
      continue;
    }
    F = point.F_C;
    if (++ended == 3) {
      next_s = s / 2;
      ended = 0;
    }
    const double natural_map = relative_natural_map(problem, F);
    if (natural_map < result.natural_map_residual) {
      result.F_C = F;
      result.natural_map_residual = natural_map;
    }
    if (natural_map < to_halve / 2) {
      to_halve = natural_map;
      since_halved = 0;
    }
  }
  result.converged = result.natural_map_residual <= std::max(options.tolerance, options.acceptable);
}

}  // namespace airybench
