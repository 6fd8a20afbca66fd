// The contact law's part of the judge, for bodies and for contact problems without one.
#include <algorithm>
#include <cmath>

#include "solvers/contact/compliance.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "verify/contact_violations.hpp"
#include "verify/verifier.hpp"

namespace airybench {
namespace {

// On |r_t| ≤ μ r_n; normal first, one or two tangential components.
Eigen::VectorXd project_on_cone(const Eigen::VectorXd& r, double mu) {
  const auto tangent = r.tail(r.size() - 1);
  const double normal = r(0), tangential = tangent.norm();
  if (tangential <= mu * normal) return r;
  if (mu * tangential <= -normal) return Eigen::VectorXd::Zero(r.size());
  Eigen::VectorXd projected(r.size());
  projected(0) = (normal + mu * tangential) / (1 + mu * mu);
  projected.tail(r.size() - 1) = mu * projected(0) / tangential * tangent;
  return projected;
}

// Verification::siconos_error with r = −F, u = W r + q; offset is q, DF is D F.
double siconos_error(const ContactPoints& points, const Eigen::VectorXd& offset,
                     const Eigen::VectorXd& F, const Eigen::VectorXd& DF) {
  const Eigen::VectorXd r = -F, u = offset - DF;
  const int m = points.components;
  double squared = 0;
  for (int p = 0; p < points.count; ++p) {
    const double mu = points.friction_at(p);
    const auto r_p = r.segment(m * p, m), u_p = u.segment(m * p, m);
    Eigen::VectorXd shifted = r_p - u_p;
    shifted(0) -= mu * u_p.tail(m - 1).norm();
    squared += (r_p - project_on_cone(shifted, mu)).squaredNorm();
  }
  const double scale = std::max({r.norm(), u.norm(), offset.norm()});
  return scale > 0 ? std::sqrt(squared) / scale : 0;
}

// block: of a point's rows of D.
template <typename Block>
double friction_coupling(const ContactPoints& contact, Block block) {
  const int m = contact.components;
  double coupling = 0;
  for (int p = 0; p < contact.count; ++p) {
    const Eigen::MatrixXd D_pp = block(p);
    coupling =
        std::max(coupling, contact.friction_at(p) * D_pp.col(0).tail(m - 1).norm() / D_pp(0, 0));
  }
  return coupling;
}

}  // namespace

std::vector<ContactState> contact_states(const ContactPoints& contact, const Eigen::VectorXd& F_C) {
  constexpr double tolerance = 1e-9;
  const int m = contact.components;
  double largest = 0;
  for (int p = 0; p < contact.count; ++p) largest = std::max(largest, std::abs(F_C(m * p)));
  std::vector<ContactState> states(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) {
    const double normal = std::abs(F_C(m * p));
    if (normal <= tolerance * largest)
      states[p] = ContactState::open;
    else if (m == 1 ||
             tangential_force(contact, F_C, p) >= (1 - tolerance) * contact.friction_at(p) * normal)
      states[p] = ContactState::slip;
    else
      states[p] = ContactState::stick;
  }
  return states;
}

void note_contact_forces(const ContactPoints& all, const Eigen::VectorXd& F_all,
                         Verification& result) {
  const ContactPoints contact = joined(all);
  const Eigen::VectorXd F = of_first(all, F_all);
  const int m = contact.components;
  double normal = 0, tangential = 0;
  for (int p = 0; p < contact.count; ++p) {
    normal += F(m * p);
    if (m == 2) tangential += F(m * p + 1);
  }
  result.normal_resultant_N = normal;
  if (m < 3) result.tangential_resultant_N = tangential;  // in space tangents are arbitrary
  const ForceViolations violations = force_violations(contact, F);
  result.tension = violations.tension;
  if (m > 1) result.friction_excess = violations.friction_excess;
  note_contact_states(contact, F, result);
}

void note_contact_states(const ContactPoints& contact, const Eigen::VectorXd& F,
                         Verification& result) {
  const std::vector<ContactState> states = contact_states(contact, F);
  const auto count = [&](ContactState state) {
    return static_cast<int>(std::count(states.begin(), states.end(), state));
  };
  result.n_open = count(ContactState::open);
  result.n_stick = count(ContactState::stick);
  result.n_slip = count(ContactState::slip);
}

void note_contact_law(const ContactPoints& contact, const Eigen::VectorXd& F,
                      const Eigen::VectorXd& displacement, const Eigen::VectorXd& D_diagonal,
                      const LoadScale& scale, Verification& result) {
  const int m = contact.components;
  const Eigen::VectorXd residual = natural_map(contact, D_diagonal, F, displacement);
  result.natural_map_residual = scale.relative_force(residual.norm(), F.norm());
  double signorini = 0, coulomb = 0;
  for (int p = 0; p < contact.count; ++p) {
    signorini = std::max(signorini, std::abs(residual(m * p)));
    coulomb = std::max(coulomb, tangential_force(contact, residual, p));
  }
  result.signorini_violation_N = signorini;
  if (m > 1) result.coulomb_violation_N = coulomb;
}

void note_slip(const Problem& problem, const ContactPoints& contact, const Eigen::VectorXd& F,
               const Eigen::VectorXd& displacement, const Eigen::VectorXd& expected,
               const Eigen::VectorXd& D_diagonal, const LoadScale& scale, Verification& result) {
  const bool on_path = !problem.later_steps.empty() || problem.loads.slid_mm.size() > 0;
  if (!on_path || contact.components != 2) return;
  const Eigen::VectorXd off = (displacement - expected).cwiseQuotient(D_diagonal);
  result.slip_off_N = off(Eigen::seq(1, Eigen::last, 2)).norm();
  result.slip_off = scale.relative_force(result.slip_off_N, F.norm());
}

void note_contact(const ContactPoints& points, const Eigen::MatrixXd& D, const Eigen::VectorXd& F,
                  const Eigen::VectorXd& displacement, const LoadScale& scale,
                  Verification& result) {
  note_contact_forces(points, F, result);
  note_contact_law(points, F, displacement, D.diagonal(), scale, result);
  const int m = points.components;
  if (m > 1)
    result.friction_coupling = friction_coupling(points, [&](int p) -> Eigen::MatrixXd {
      const int q = points.opposite_of(p);
      Eigen::MatrixXd block = D.block(m * p, m * p, m, m);
      if (q != ContactPoints::no_point)  // one force acts on both, and r is the sum
        block +=
            D.block(m * p, m * q, m, m) + D.block(m * q, m * p, m, m) + D.block(m * q, m * q, m, m);
      return block;
    });
}

Verification verify(const contact::Problem& problem, const Eigen::VectorXd& F) {
  const Eigen::VectorXd DF = D_times(problem, F), offset = contact_offset(problem),
                        diagonal = D_diagonal(problem);
  LoadScale scale;  // forces that cancel the offset point by point
  scale.force_N = offset.cwiseQuotient(diagonal).norm();
  Verification result;
  result.equilibrium_residual.reset();
  note_contact_forces(problem.points, F, result);
  note_contact_law(problem.points, F, DF - problem.G, diagonal, scale, result);
  result.strain_energy_Nmm = F.dot(DF) / 2;
  if (problem.points.components == 1) return result;
  result.siconos_error = siconos_error(problem.points, offset, F, DF);
  if (!problem.bodies)
    result.friction_coupling =
        friction_coupling(problem.points, [&](int p) { return D_of_point(problem, p); });
  return result;
}

}  // namespace airybench
