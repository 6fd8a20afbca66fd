#include "solvers/contact/point_laws.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

PointLaw law_at(const ContactPoints& contact, const Eigen::VectorXd& trial, int p) {
  const int m = contact.components, n = m * p;
  PointLaw law;
  law.closed = trial(n) < 0;
  if (!law.closed || m == 1) return law;
  const double mu = contact.friction_at(p);
  law.sticks = trial.segment(n + 1, m - 1).norm() <= -mu * trial(n);
  if (!law.sticks && m == 2) law.ratio = trial(n + 1) > 0 ? -mu : mu;
  return law;
}

// Of those laws that would change, so many, where the natural map is largest.
std::vector<PointLaw> changed_in_part(const std::vector<PointLaw>& laws,
                                      const std::vector<PointLaw>& next, const Eigen::VectorXd& map,
                                      double share) {
  std::vector<int> changes;
  for (int p = 0; p < static_cast<int>(laws.size()); ++p)
    if (!(laws[p] == next[p])) changes.push_back(p);
  const auto m = map.size() / static_cast<Eigen::Index>(laws.size());
  std::ranges::sort(changes, std::greater(),
                    [&](int p) { return map.segment(m * p, m).squaredNorm(); });
  const auto count = std::max(1.0, std::ceil(share * static_cast<double>(changes.size())));
  changes.resize(std::min(changes.size(), static_cast<std::size_t>(count)));
  std::vector<PointLaw> result = laws;
  for (const int p : changes) result[p] = next[p];
  return result;
}

}  // namespace

std::vector<PointLaw> laws_of(const ContactPoints& contact, const Eigen::VectorXd& trial) {
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) laws[p] = law_at(contact, trial, p);
  return laws;
}

Eigen::VectorXd forces_under(const ContactPoints& contact, const std::vector<PointLaw>& laws,
                             const Eigen::VectorXd& reaction) {
  const int m = contact.components;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(contact.size());
  for (int p = 0; p < contact.count; ++p) {
    const PointLaw& law = laws[p];
    if (!law.closed) continue;
    F(m * p) = reaction(m * p);
    if (m == 2) F(m * p + 1) = law.sticks ? reaction(m * p + 1) : law.ratio * F(m * p);
  }
  return F;
}

LawChoice::Next LawChoice::after(const ContactPoints& contact, const Eigen::VectorXd& compliance,
                                 const std::vector<PointLaw>& laws, const Eigen::VectorXd& F_C,
                                 const Eigen::VectorXd& u_C, const LoadScale& scale,
                                 double tolerance) {
  constexpr int patience = 8;
  const Eigen::VectorXd map = natural_map(contact, compliance, F_C, u_C);
  Next next = {scale.relative_force(map.norm(), F_C.norm()), {}};
  ++since_halved_;
  if (next.natural_map < to_halve_ / 2) {
    to_halve_ = next.natural_map;
    share_ = std::min(1.0, 2 * share_);
    since_halved_ = 0;
  }
  const std::vector<PointLaw> all =
      laws_of(contact, trial_forces(contact, compliance, F_C, relative_to_gap(contact, u_C)));
  if (all == laws || next.natural_map <= tolerance) return next;
  if (since_halved_ > patience) {
    share_ /= 2;
    since_halved_ = 0;
  }
  next.laws = share_ < 1 ? changed_in_part(laws, all, map, share_) : all;
  return next;
}

}  // namespace airybench
