#include "solvers/active_sets/active_rows.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/problem/load_scale.hpp"

namespace airybench {
namespace {

// GMRES keeps so much of its basis at most.
int iterations_at_once(Eigen::Index rows) {
  constexpr std::size_t max_bytes = 2'000'000'000;
  const std::size_t vectors = max_bytes / (static_cast<std::size_t>(rows) * sizeof(double));
  return static_cast<int>(std::clamp(vectors, std::size_t{12}, std::size_t{40}));
}

class RowsNewton {
 public:
  RowsNewton(ContactRows& rows, const LoadScale& scale, const RowsOptions& options)
      : rows_(rows), scale_(scale), options_(options) {
    now_.u.setZero(rows.slots());
    best_.natural_map_residual = std::numeric_limits<double>::infinity();
    if (rows.contact.count > 0) now_.laws = rows.first_laws(now_.sweeps);
  }

  RowsResult solve() {
    RowsResult result = iterate();
    constexpr std::size_t vectors = 5;  // u, the best u, unbalanced, its copy, correction
    result.bytes = vectors * static_cast<std::size_t>(unbalanced_.size()) * sizeof(double);
    return result;
  }

 private:
  RowsResult iterate() {
    constexpr int max_steps = 100;
    double target = 1e-2;
    while (now_.steps < max_steps) {
      hold_laws();
      solve_linear(target);
      if (choose_laws()) {
        target = std::clamp(now_.natural_map_residual / 10, options_.tolerance, 1e-2);
      } else {
        now_.converged = now_.linear_error <= std::max(options_.tolerance, options_.acceptable);
        if (now_.converged || target <= options_.tolerance) return std::move(now_);
        target =
            std::max(options_.tolerance, rows_.next_target * std::min(target, now_.linear_error));
      }
    }
    for (const auto count : {&RowsResult::steps, &RowsResult::sweeps}) best_.*count = now_.*count;
    for (const auto count : {&RowsResult::iterations, &RowsResult::max_in_a_step})
      best_.*count = now_.*count;
    best_.history = std::move(now_.history);
    return std::move(best_);
  }

  void hold_laws() {
    if (now_.laws == held_laws_ && now_.steps > 0) return;
    rows_.set(now_.laws);
    held_laws_ = now_.laws;
    rows_.move_to_gap(now_.u);
    measure();
    ++now_.steps;
  }

  // The forces that u leaves, and the energy norm of all of it.
  void measure() { size_ = std::sqrt(std::max(0.0, rows_.measure(now_.u, unbalanced_))); }

  // Until the linear error is below the target, or no longer falls.
  void solve_linear(double target) {
    constexpr int max_cycles = 50;
    const std::int64_t before = now_.iterations;
    for (int cycle = 0, idle = 0; cycle < max_cycles && idle < 2; ++cycle) {
      const double enough = target / rows_.condition * (size_ > 0 ? size_ : scale_.energy_norm);
      const GmresOptions options{1e-8, enough / 2, iterations_at_once(unbalanced_.size())};
      const GmresResult linear = rows_.solve(unbalanced_, options, correction_);
      now_.iterations += linear.iterations;
      now_.max_in_a_step = std::max(now_.max_in_a_step, now_.iterations - before);
      now_.u += correction_;
      measure();
      const double left = rows_.error_left(linear, unbalanced_, target <= options_.tolerance);
      now_.linear_error = scale_.relative_energy(left, size_);
      now_.history.push_back(now_.linear_error);
      if (now_.linear_error <= target) return;
      if (linear.reduction > 0.5) ++idle;
    }
  }

  // Forces, natural map and the laws that follow; whether these change.
  bool choose_laws() {
    now_.F_C = forces_under(rows_.contact, now_.laws, rows_.reactions(unbalanced_));
    if (rows_.contact.count == 0) return false;
    LawChoice::Next next = choice_.after(rows_.contact, rows_.compliance, now_.laws, now_.F_C,
                                         rows_.of_contact(now_.u), scale_, options_.tolerance);
    now_.natural_map_residual = next.natural_map;
    if (now_.natural_map_residual < best_.natural_map_residual) best_ = now_;
    if (next.laws.empty()) return false;
    now_.laws = std::move(next.laws);
    return true;
  }

  ContactRows& rows_;
  const LoadScale scale_;
  const RowsOptions options_;
  RowsResult now_, best_;
  std::vector<PointLaw> held_laws_;
  Eigen::VectorXd unbalanced_, correction_;
  LawChoice choice_;
  double size_ = 0;
};

}  // namespace

RowsResult solve_contact_on_rows(ContactRows& rows, const LoadScale& scale,
                                 const RowsOptions& options) {
  return RowsNewton(rows, scale, options).solve();
}

}  // namespace airybench
