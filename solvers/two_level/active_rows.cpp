#include "solvers/two_level/active_rows.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/rough_compliance.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// The laws that points begin with: those of the coarse contact problem.
std::vector<PointLaw> first_laws(const SlotSystem& s, TwoLevelPreconditioner& M,
                                 const RunControl& control, RowsResult& result) {
  M.hold(s.prescribed);
  std::vector<PointLaw> laws(static_cast<std::size_t>(s.contact.count));
  const CoarseContact coarse = M.coarse().contact_problem(s.contact, s.b);
  const auto& [D, G, points, unnamed] = coarse.problem;
  if (points.count == 0) return laws;
  RunControl rough = control;
  rough.contact_tolerance = 1e-6;
  rough.contact_sweeps = 1000;
  rough.histories = false;
  const ContactResult of_coarse = solve_contact_by_newton(coarse.problem, rough);
  result.sweeps = of_coarse.iterations;
  const Eigen::VectorXd& F = of_coarse.F_C;
  const Eigen::VectorXd r = relative_to_gap(points, Eigen::VectorXd(times(D, F) - G));
  const std::vector<PointLaw> at_coarse = laws_of(points, F - r.cwiseQuotient(D.diagonal()));
  for (std::size_t p = 0; p < laws.size(); ++p)
    if (coarse.of_point[p] >= 0) laws[p] = at_coarse[coarse.of_point[p]];
  return laws;
}

// Moves held contact slots to where they are held.
void move_to_gap(const SlotSystem& s, const std::vector<PointLaw>& laws, Eigen::VectorXd& u) {
  const int m = s.contact.components;
  const auto gap = [&](int row) { return s.contact.gap.size() > 0 ? s.contact.gap(row) : 0.0; };
  for (int p = 0; p < s.contact.count; ++p) {
    if (laws[p].closed) u(s.slot[p]) = gap(m * p);
    if (laws[p].sticks) u(s.slot[p] + 1) = gap(m * p + 1);
  }
}

}  // namespace

SlotSystem::SlotSystem(const Problem& problem, const ContactPoints& points,
                       const HybridizedSystem& system, const EdgeMatrix& matrix)
    : K(matrix),
      b(to_slots(matrix, system.unknown, system.b)),
      prescribed_u(prescribed_in_slots(matrix, system)),
      prescribed(prescribed_slots(matrix, system.unknown)),
      contact(points),
      compliance(rough_compliance(problem, points)) {
  K.multiply(prescribed_u, K_times_u);
  for (int p = 0; p < points.count; ++p) {
    const int edge = problem.edges.of_boundary[points.boundary[p]];
    slot.push_back(4 * static_cast<Eigen::Index>(matrix.block_of_edge[edge]) + 2 * (p % 2));
  }
}

Eigen::VectorXd SlotSystem::of_contact(const Eigen::VectorXd& x) const {
  const int m = contact.components;
  Eigen::VectorXd rows(contact.size());
  for (int p = 0; p < contact.count; ++p) rows.segment(m * p, m) = x.segment(slot[p], m);
  return rows;
}

void LinearisedContact::set(const std::vector<PointLaw>& laws) {
  laws_ = laws;
  held_ = s_.prescribed;
  for (std::size_t p = 0; p < laws.size(); ++p) {
    if (laws[p].closed) held_.push_back(s_.slot[p]);
    if (laws[p].sticks) held_.push_back(s_.slot[p] + 1);
  }
  M_.hold(held_);
}

void LinearisedContact::reduce(Eigen::VectorXd& r) const {
  for (std::size_t p = 0; p < laws_.size(); ++p)
    if (laws_[p].ratio != 0) r(s_.slot[p] + 1) -= laws_[p].ratio * r(s_.slot[p]);
  for (const Eigen::Index slot : held_) r(slot) = 0;
}

GmresResult LinearisedContact::solve(Eigen::VectorXd r, const GmresOptions& options,
                                     const Deadline& deadline, Eigen::VectorXd& x) {
  reduce(r);
  return solve_by_gmres(
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
        const SecondsInto timer(M_.times().matrix_s);
        s_.K.multiply(v, y);
        reduce(y);
      },
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { M_.apply(v, y); }, r, options, deadline,
      space_, x);
}

namespace {

// GMRES keeps so much of its basis at most.
int iterations_at_once(Eigen::Index rows) {
  constexpr std::size_t most_bytes = 2'000'000'000;
  const std::size_t vectors = most_bytes / (static_cast<std::size_t>(rows) * sizeof(double));
  return static_cast<int>(std::clamp(vectors, std::size_t{12}, std::size_t{40}));
}

class RowsNewton {
 public:
  RowsNewton(const SlotSystem& system, TwoLevelPreconditioner& M, double scale,
             const RunControl& control)
      : s_(system), linearised_(system, M), scale_(scale), control_(control) {
    now_.u.setZero(s_.K.slots());
    best_.natural_map_residual = std::numeric_limits<double>::infinity();
    if (s_.contact.count > 0) now_.laws = first_laws(s_, M, control, now_);
  }

  RowsResult solve() {
    RowsResult result = iterate();
    constexpr std::size_t vectors = 5;  // u, the best u, unbalanced, its copy, correction
    result.bytes = linearised_.bytes() +
                   vectors * static_cast<std::size_t>(unbalanced_.size()) * sizeof(double);
    return result;
  }

 private:
  RowsResult iterate() {
    constexpr int most_steps = 100;
    double target = 1e-2;
    while (now_.steps < most_steps) {
      hold_laws();
      solve_linear(target);
      if (choose_laws()) {
        target = std::clamp(now_.natural_map_residual / 10, control_.tolerance, 1e-2);
      } else {
        now_.converged =
            now_.linear_error <= std::max(control_.tolerance, control_.target_error / 1000);
        if (now_.converged || target <= control_.tolerance) return std::move(now_);
        target = control_.tolerance;
      }
    }
    for (const auto count : {&RowsResult::steps, &RowsResult::sweeps}) best_.*count = now_.*count;
    best_.iterations = now_.iterations;
    best_.history = std::move(now_.history);
    return std::move(best_);
  }

  void hold_laws() {
    if (now_.laws == held_laws_ && now_.steps > 0) return;
    linearised_.set(now_.laws);
    held_laws_ = now_.laws;
    move_to_gap(s_, now_.laws, now_.u);
    measure();
    ++now_.steps;
  }

  // The forces that u leaves, and the energy norm of all of it.
  void measure() {
    const Eigen::VectorXd all = now_.u + s_.prescribed_u;
    s_.K.multiply(all, unbalanced_);
    size_ = std::sqrt(std::max(0.0, unbalanced_.dot(all)));
    unbalanced_ = s_.b + s_.K_times_u - unbalanced_;
  }

  // Until the linear error is below the target, or no longer falls.
  void solve_linear(double target) {
    constexpr int most_cycles = 50;
    for (int cycle = 0, idle = 0; cycle < most_cycles && idle < 2; ++cycle) {
      const double enough = target / two_level_condition * (size_ > 0 ? size_ : scale_);
      const GmresOptions options{1e-8, enough / 2, iterations_at_once(unbalanced_.size()),
                                 s_.K.threads};
      const GmresResult linear =
          linearised_.solve(unbalanced_, options, control_.deadline, correction_);
      now_.iterations += linear.iterations;
      now_.u += correction_;
      measure();
      now_.linear_error =
          relative_error(two_level_condition * linear.reduction * linear.norm, size_, scale_);
      now_.history.push_back(now_.linear_error);
      if (now_.linear_error <= target) return;
      if (linear.reduction > 0.5) ++idle;
    }
  }

  // Forces, natural map and the laws that follow; whether these change.
  bool choose_laws() {
    now_.F_C = forces_under(s_.contact, now_.laws, -s_.of_contact(unbalanced_));
    if (s_.contact.count == 0) return false;
    LawChoice::Next next = choice_.after(s_.contact, s_.compliance, now_.laws, now_.F_C,
                                         s_.of_contact(now_.u), control_.tolerance);
    now_.natural_map_residual = next.natural_map;
    if (now_.natural_map_residual < best_.natural_map_residual) best_ = now_;
    if (next.laws.empty()) return false;
    now_.laws = std::move(next.laws);
    return true;
  }

  const SlotSystem& s_;
  LinearisedContact linearised_;
  double scale_;
  const RunControl& control_;
  RowsResult now_, best_;
  std::vector<PointLaw> held_laws_;
  Eigen::VectorXd unbalanced_, correction_;
  LawChoice choice_;
  double size_ = 0;
};

}  // namespace

RowsResult solve_contact_on_rows(const SlotSystem& system, TwoLevelPreconditioner& M, double scale,
                                 const RunControl& control) {
  return RowsNewton(system, M, scale, control).solve();
}

}  // namespace airybench
