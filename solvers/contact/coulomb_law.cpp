#include "solvers/contact/coulomb_law.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace airybench {
namespace {

// How far (F, D F + b) is from the law, N: the natural map's norm.
double violation(const Eigen::Matrix2d& D, const Eigen::Vector2d& b, double mu,
                 const Eigen::Vector2d& F) {
  const Eigen::Vector2d r = D * F + b;
  return (F - project_on_coulomb(F - r.cwiseQuotient(D.diagonal()), mu)).norm();
}

}  // namespace

double solve_signorini_law(double D, double b) { return std::min(0.0, -b / D); }

Eigen::Vector2d project_on_coulomb(const Eigen::Vector2d& F, double mu) {
  const double normal = std::min(F(0), 0.0);
  return {normal, std::clamp(F(1), mu * normal, -mu * normal)};
}

void project_in_place(const ContactPoints& contact, Eigen::Ref<Eigen::VectorXd> F) {
  for (int p = 0; p < contact.count; ++p) {
    if (contact.components == 2)
      F.segment<2>(2 * p) =
          project_on_coulomb(Eigen::Vector2d(F.segment<2>(2 * p)), contact.friction_at(p));
    else
      F(p) = std::min(F(p), 0.0);
  }
}

Eigen::VectorXd project_on_coulomb(const ContactPoints& contact, Eigen::VectorXd F) {
  project_in_place(contact, F);
  return F;
}

Eigen::Vector2d solve_coulomb_law(const Eigen::Matrix2d& D, const Eigen::Vector2d& b, double mu) {
  if (b(0) <= 0) return Eigen::Vector2d::Zero();  // open: F = 0, r = b

  const Eigen::Vector2d stick = -(D.inverse() * b);
  if (stick(0) <= 0 && std::abs(stick(1)) <= -mu * stick(0)) return stick;

  // Slip: F_t = −τ μ F_n with τ the sign of F_t, r_n = (D_nn − τ μ D_nt) F_n + b_n = 0.
  std::array<Eigen::Vector2d, 2> slip;
  for (int k = 0; k < 2; ++k) {
    const double tau = k == 0 ? 1 : -1;
    const double stiffness = D(0, 0) - tau * mu * D(0, 1);
    const double normal = stiffness > 0 ? -b(0) / stiffness : 0;
    slip[k] = {normal, -tau * mu * normal};
    const double r_t = D.row(1) * slip[k] + b(1);
    if (stiffness > 0 && tau * r_t <= 0) return slip[k];
  }
  const std::array<Eigen::Vector2d, 4> candidates = {
      slip[0], slip[1], project_on_coulomb(stick, mu), Eigen::Vector2d::Zero()};
  return *std::min_element(candidates.begin(), candidates.end(), [&](const auto& x, const auto& y) {
    return violation(D, b, mu, x) < violation(D, b, mu, y);
  });
}

Eigen::VectorXd natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd r = relative_to_gap(contact, displacement);
  return F_C - project_on_coulomb(contact, F_C - r.cwiseQuotient(D_diagonal));
}

double relative_natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement) {
  const double norm = F_C.norm(), map = natural_map(contact, D_diagonal, F_C, displacement).norm();
  return norm > 0 ? map / norm : map;
}

}  // namespace airybench
