#include "solvers/two_level/slot_rows.hpp"

#include "assembly/rough_compliance.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {

SlotRows::SlotRows(const Problem& problem, const ContactPoints& points,
                   const HybridizedSystem& system, const EdgeMatrix& K, TwoLevelPreconditioner& M,
                   const Deadline& deadline)
    : ContactRows(points, rough_compliance(problem, points), two_level_condition),
      K_(K),
      M_(M),
      deadline_(deadline),
      b_(to_slots(K, system.unknown, system.b)),
      prescribed_u_(prescribed_in_slots(K, system)),
      prescribed_(prescribed_slots(K, system.unknown)) {
  K.multiply(prescribed_u_, K_times_u_);
  for (int p = 0; p < points.count; ++p) {
    const int edge = problem.edges.of_boundary[points.boundary[p]];
    slot_.push_back(4 * static_cast<Eigen::Index>(K.block_of_edge[edge]) + 2 * (p % 2));
  }
}

std::size_t SlotRows::bytes() const {
  return space_.bytes() + static_cast<std::size_t>(b_.size() + prescribed_u_.size() +
                                                   K_times_u_.size() + compliance.size()) *
                              sizeof(double);
}

std::vector<PointLaw> SlotRows::first_laws(int& sweeps) {
  M_.hold(prescribed_);
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  const CoarseContact coarse = M_.coarse().contact_problem(contact, b_);
  const Eigen::MatrixXd& D = coarse.problem.D;
  const ContactPoints& points = coarse.problem.points;
  if (points.count == 0) return laws;
  const ContactOptions rough = {.tolerance = 1e-6, .max_iterations = 1000};
  const ContactResult of_coarse = solve_contact_by_newton(coarse.problem, rough, deadline_);
  sweeps = of_coarse.iterations;
  const Eigen::VectorXd& F = of_coarse.F_C;
  const Eigen::VectorXd r =
      relative_to_gap(points, Eigen::VectorXd(times(D, F) - coarse.problem.G));
  const std::vector<PointLaw> at_coarse = laws_of(points, trial_forces(points, D.diagonal(), F, r));
  for (std::size_t p = 0; p < laws.size(); ++p)
    if (coarse.of_point[p] >= 0) laws[p] = at_coarse[coarse.of_point[p]];
  return laws;
}

void SlotRows::set(const std::vector<PointLaw>& laws) {
  laws_ = laws;
  held_ = prescribed_;
  for (std::size_t p = 0; p < laws.size(); ++p) {
    if (laws[p].closed) held_.push_back(slot_[p]);
    if (laws[p].sticks) held_.push_back(slot_[p] + 1);
  }
  M_.hold(held_);
}

void SlotRows::move_to_gap(Eigen::VectorXd& u) const {
  const int m = contact.components;
  const auto gap = [&](int row) { return contact.gap.size() > 0 ? contact.gap(row) : 0.0; };
  for (int p = 0; p < contact.count; ++p) {
    if (laws_[p].closed) u(slot_[p]) = gap(m * p);
    if (laws_[p].sticks) u(slot_[p] + 1) = gap(m * p + 1);
  }
}

double SlotRows::measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) {
  const Eigen::VectorXd all = u + prescribed_u_;
  K_.multiply(all, unbalanced);
  const double energy = unbalanced.dot(all);
  unbalanced = b_ + K_times_u_ - unbalanced;
  return energy;
}

void SlotRows::reduce(Eigen::VectorXd& r) const {
  for (std::size_t p = 0; p < laws_.size(); ++p)
    if (laws_[p].ratio != 0) r(slot_[p] + 1) -= laws_[p].ratio * r(slot_[p]);
  for (const Eigen::Index slot : held_) r(slot) = 0;
}

GmresResult SlotRows::solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) {
  reduce(r);
  GmresOptions own = options;
  own.threads = K_.threads;
  return solve_by_gmres(
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
        const SecondsInto timer(M_.times().matrix_s);
        K_.multiply(v, y);
        reduce(y);
      },
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { M_.apply(v, y); }, r, own, deadline_,
      space_, x);
}

Eigen::VectorXd SlotRows::of_contact(const Eigen::VectorXd& x) const {
  const int m = contact.components;
  Eigen::VectorXd rows(contact.size());
  for (int p = 0; p < contact.count; ++p) rows.segment(m * p, m) = x.segment(slot_[p], m);
  return rows;
}

double SlotRows::norm_from_below(const Eigen::VectorXd& F_C) {
  const int m = contact.components;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(K_.slots()), z;
  for (int p = 0; p < contact.count; ++p) F.segment(slot_[p], m) = F_C.segment(m * p, m);
  M_.apply(F, z);
  return std::sqrt(std::max(0.0, F.dot(z)));
}

}  // namespace airybench
