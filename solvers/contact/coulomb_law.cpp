#include "solvers/contact/coulomb_law.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace airybench {
namespace {

// How far (F, D F + b) is from the law, N: the natural map's norm.
double violation(const Eigen::Matrix2d& D, const Eigen::Vector2d& b, double mu,
                 const Eigen::Vector2d& F) {
  const Eigen::Vector2d r = D * F + b;
  return (F - project_on_coulomb(F - r.cwiseQuotient(D.diagonal()), mu)).norm();
}

Eigen::Vector3d project_in_space(const Eigen::Vector3d& F, double mu) {
  const double normal = std::min(F(0), 0.0), bound = -mu * normal;
  const double tangential = F.tail<2>().norm();
  Eigen::Vector3d projected(normal, F(1), F(2));
  if (tangential > bound) projected.tail<2>() *= bound / tangential;
  return projected;
}

}  // namespace

double solve_signorini_law(double D, double b) { return std::min(0.0, -b / D); }

Eigen::Vector2d project_on_coulomb(const Eigen::Vector2d& F, double mu) {
  const double normal = std::min(F(0), 0.0);
  return {normal, std::clamp(F(1), mu * normal, -mu * normal)};
}

void project_in_place(const ContactPoints& contact, Eigen::Ref<Eigen::VectorXd> F) {
  for (int p = 0; p < contact.count; ++p) {
    const double mu = contact.friction_at(p);
    if (contact.components == 3)
      F.segment<3>(3 * p) = project_in_space(F.segment<3>(3 * p), mu);
    else if (contact.components == 2)
      F.segment<2>(2 * p) = project_on_coulomb(Eigen::Vector2d(F.segment<2>(2 * p)), mu);
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

Eigen::Vector3d solve_coulomb_law(const Eigen::Matrix3d& D, const Eigen::Vector3d& b, double mu) {
  if (b(0) <= 0) return Eigen::Vector3d::Zero();  // open
  const Eigen::Vector2d D_tn = D.block<2, 1>(1, 0);
  const Eigen::Vector2d c = b.tail<2>() - D_tn * (b(0) / D(0, 0));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> S = [&] {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> values;
    values.computeDirect(D.bottomRightCorner<2, 2>() - D_tn * D_tn.transpose() / D(0, 0));
    return values;
  }();
  const double scale = D(1, 1) + D(2, 2);
  const double least = std::numeric_limits<double>::epsilon() * (scale > 0 ? scale : D(0, 0));
  const Eigen::Vector2d s = S.eigenvalues().cwiseMax(least);
  const Eigen::Vector2d c_s = S.eigenvectors().transpose() * c;
  const Eigen::Vector2d n_s = S.eigenvectors().transpose() * D_tn / D(0, 0);

  struct Slip {
    Eigen::Vector2d tangential;  // along the eigenvectors
    double normal;
    double excess;  // |F_t| + μ F_n
    double step;    // of Newton's method for κ; NaN where F_n ≥ 0
  };
  const auto slip_with = [&](double kappa) {
    Slip slip;
    const Eigen::Vector2d compliance = s.array() + kappa;
    slip.tangential = -c_s.cwiseQuotient(compliance);
    slip.normal = -b(0) / D(0, 0) - n_s.dot(slip.tangential);
    const double norm = slip.tangential.norm(), bound = -mu * slip.normal;
    slip.excess = norm - bound;
    const Eigen::Vector2d change = -slip.tangential.cwiseQuotient(compliance);
    const double norm_change = slip.tangential.dot(change) / norm;
    const double bound_change = mu * n_s.dot(change);
    slip.step = bound > 0 ? (1 / norm - 1 / bound) /
                                (norm_change / (norm * norm) - bound_change / (bound * bound))
                          : std::numeric_limits<double>::quiet_NaN();
    return slip;
  };
  const auto forces = [&](const Slip& slip) {
    Eigen::Vector3d F;
    F << slip.normal, S.eigenvectors() * slip.tangential;
    return F;
  };
  if (mu == 0) return {-b(0) / D(0, 0), 0, 0};
  const Slip stick = slip_with(0);
  if (stick.excess <= 0) return forces(stick);

  constexpr int max_steps = 100;
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  double low = 0, high = std::numeric_limits<double>::infinity(), kappa = 0;
  Slip slip = stick;
  for (int step = 0; step < max_steps; ++step) {
    (slip.excess > 0 ? low : high) = kappa;
    double next = kappa + slip.step;
    if (!(next > low && next < high))
      next = std::isinf(high) ? 4 * std::max(low, scale) : (low + high) / 2;
    const double change = std::abs(next - kappa);
    kappa = next;
    slip = slip_with(kappa);
    if (change <= rounding * kappa) break;
  }
  return project_in_space(forces(slip), mu);
}

Eigen::VectorXd trial_forces(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                             const Eigen::VectorXd& F, const Eigen::VectorXd& r) {
  Eigen::VectorXd trial = F - r.cwiseQuotient(sums_of_pairs(contact, D_diagonal));
  if (contact.components != 3) return trial;
  for (int t = 1; t < trial.size(); t += 3)
    trial.segment<2>(t) = F.segment<2>(t) - r.segment<2>(t) / D_diagonal.segment<2>(t).mean();
  return trial;
}

Eigen::VectorXd natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement) {
  return natural_map_of(contact, D_diagonal, F_C, relative_to_gap(contact, displacement));
}

Eigen::VectorXd natural_map_of(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                               const Eigen::VectorXd& F_C, const Eigen::VectorXd& r) {
  return F_C - project_on_coulomb(contact, trial_forces(contact, D_diagonal, F_C, r));
}

double size_of_forces(double norm_N, double undoing_N) {
  constexpr double rounding = 1e-9;
  const bool is_rounding = norm_N > 0 && norm_N <= rounding * undoing_N;
  return is_rounding && std::isfinite(undoing_N) ? undoing_N : norm_N;
}

double relative_natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement,
                            double undoing_N) {
  const double size = size_of_forces(F_C.norm(), undoing_N),
               map = natural_map(contact, D_diagonal, F_C, displacement).norm();
  return size > 0 ? map / size : map;
}

}  // namespace airybench
