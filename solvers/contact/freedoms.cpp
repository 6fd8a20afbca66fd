#include "solvers/contact/freedoms.hpp"

#include <algorithm>

#include "solvers/contact/point_laws.hpp"

namespace airybench {
namespace {

Freedom along(int first, int component) {
  return {first, component, Eigen::Vector3d::Unit(component)};
}

// Of a point that slips in space, where z = (F − ρ r)_t, e = z/|z|, q = −|z| / (μ F_n) ≥ 1: along e
// F_t = −μ F_n e, and across it, f ⊥ e, Newton's method for F_t = (−μ F_n / |z|) z says
//
//   f · r_t + (q − 1) f · F_t / ρ = 0,  which is f · r_t = 0 at the onset of slip.
void add_slip_in_space(int n, double mu, double rho, const Eigen::Vector3d& trial,
                       Eigen::VectorXd& F, std::vector<Freedom>& freedoms) {
  const Eigen::Vector2d e = trial.tail<2>().normalized(), f(-e.y(), e.x());
  const double across = f.dot(F.segment<2>(n + 1));
  Freedom normal = along(n, 0);
  normal.force.tail<2>() = -mu * e;
  freedoms.push_back(normal);
  F.segment<2>(n + 1) = -mu * F(n) * e + across * f;
  if (mu == 0) return;
  const double q = std::max(1.0, -trial.tail<2>().norm() / (mu * std::min(trial(0), 0.0)));
  const double diagonal = (q - 1) / rho;
  freedoms.push_back({n, across_slip, {0, f.x(), f.y()}, diagonal, diagonal * across});
}

}  // namespace

std::vector<Freedom> freedoms_of(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                                 const Eigen::VectorXd& trial, Eigen::VectorXd& F) {
  const int m = contact.components;
  std::vector<Freedom> freedoms;
  freedoms.reserve(static_cast<std::size_t>(F.size()));
  const std::vector<PointLaw> laws = laws_of(contact, trial);
  for (int p = 0; p < contact.count; ++p) {
    const int n = m * p;
    if (!laws[p].closed) {
      F.segment(n, m).setZero();
    } else if (m == 1 || laws[p].sticks) {
      for (int k = 0; k < m; ++k) freedoms.push_back(along(n, k));
    } else if (m == 2) {
      Freedom slip = along(n, 0);
      slip.force(1) = laws[p].ratio;
      F(n + 1) = slip.force(1) * F(n);
      freedoms.push_back(slip);
    } else {
      const double rho = 1 / D_diagonal.segment<2>(n + 1).mean();
      add_slip_in_space(n, contact.friction_at(p), rho, trial.segment<3>(n), F, freedoms);
    }
  }
  return freedoms;
}

}  // namespace airybench
