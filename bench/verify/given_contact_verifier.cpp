#include <algorithm>
#include <cmath>

#include "bench/verify/verifier.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// The nearest point of |t| ≤ μ n.
Eigen::Vector2d project_on_cone(const Eigen::Vector2d& r, double mu) {
  const double normal = r.x(), tangential = std::abs(r.y());
  if (tangential <= mu * normal) return r;
  if (mu * tangential <= -normal) return {0, 0};
  const double n = (normal + mu * tangential) / (1 + mu * mu);
  return {n, std::copysign(mu * n, r.y())};
}

// DF: D F.
double siconos_error(const GivenContact& given, const Eigen::VectorXd& F,
                     const Eigen::VectorXd& DF) {
  const Eigen::VectorXd r = -F, u = given.b - DF;
  double squared = 0;
  for (std::size_t p = 0; p < given.friction.size(); ++p) {
    const double mu = given.friction[p];
    const Eigen::Vector2d r_p = r.segment<2>(2 * static_cast<Eigen::Index>(p)),
                          u_p = u.segment<2>(2 * static_cast<Eigen::Index>(p));
    const Eigen::Vector2d shifted = r_p - u_p - Eigen::Vector2d(mu * std::abs(u_p.y()), 0);
    squared += (r_p - project_on_cone(shifted, mu)).squaredNorm();
  }
  const double scale = std::max({r.norm(), u.norm(), given.b.norm()});
  return scale > 0 ? std::sqrt(squared) / scale : 0;
}

}  // namespace

Verification verify_given_contact(const DualSystem& system, const Solution& solution) {
  const GivenContact& given = *system.problem->given;
  const Eigen::VectorXd& F = solution.F_C;
  const Eigen::VectorXd DF = times(given.D, F), diagonal = given.D.diagonal();
  LoadScale scale;  // forces that would undo b point by point
  scale.force_N = given.b.cwiseQuotient(diagonal).norm();
  Verification result;
  result.equilibrium_residual.reset();
  note_contact_forces(system.contact, F, result);
  note_contact_law(system.contact, F, DF - given.b, diagonal, scale, result);
  result.friction_coupling = friction_coupling(system.contact, given.D);
  result.strain_energy_Nmm = F.dot(DF) / 2;
  result.siconos_error = siconos_error(given, F, DF);
  return result;
}

}  // namespace airybench
