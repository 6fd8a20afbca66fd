#include "solvers/krylov/krylov.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace airybench {

RightHandSides columns_of(Eigen::Ref<Eigen::MatrixXd> X) {
  return {static_cast<int>(X.cols()), [X](int k, LaneColumn b) { b = X.col(k); },
          [X](int k, const LaneColumn& x) mutable { X.col(k) = x; }};
}

std::size_t iteration_bytes(const KrylovOptions& options, int count, Eigen::Index rows) {
  return static_cast<std::size_t>(std::clamp(options.threads, 1, std::max(count, 1)) *
                                  options.lanes * rows) *
         sizeof(double);
}

void KrylovSummary::add(const KrylovSummary& other) {
  converged = converged && other.converged;
  iterations += other.iterations;
  max_iterations = std::max(max_iterations, other.max_iterations);
  residual = std::max(residual, other.residual);
  if (history.empty()) history = other.history;
}

bool Lanes::any() const {
  return std::any_of(in_lane_.begin(), in_lane_.end(), [](int k) { return k != none; });
}

void Lanes::check_time(const Deadline& deadline, const char* solver, const LaneScalars& residual,
                       double tolerance) const {
  if (!deadline.passed()) return;
  int finished = next_ - begin_;
  double digits = 0, largest = 0;
  for (std::size_t l = 0; l < in_lane_.size(); ++l) {
    if (in_lane_[l] == none) continue;
    --finished;
    largest = std::max(largest, residual[l]);
    digits += std::clamp(std::log(residual[l]) / std::log(tolerance), 0.0, 1.0);
  }
  std::ostringstream message;
  message << "time limit reached during " << solver << ": " << finished << " of " << end_ - begin_
          << " right-hand sides of this thread done, the current ones at relative residuals up to "
          << largest << " (tolerance " << tolerance << ")";
  throw TimeoutReached(message.str(), (finished + digits) / (end_ - begin_), largest);
}

KrylovOptions krylov_options(const RunControl& control) {
  KrylovOptions options;
  options.tolerance = control.tolerance;
  options.max_iterations = control.max_iterations.value_or(options.max_iterations);
  options.threads = control.threads;
  return options;
}

void note_krylov(const char* solver, const KrylovSummary& summary, const KrylovOptions& options,
                 const RunControl& control, Solution& solution) {
  solution.linear_iterations = summary.iterations;
  if (control.histories)
    solution.histories.push_back(
        {std::string("relative residual of the first right-hand side, ") + solver,
         summary.history});
  if (summary.converged) return;
  std::ostringstream message;
  message << "relative residual " << summary.residual << " after " << summary.max_iterations
          << " iterations (tolerance " << options.tolerance << ")";
  stop_unconverged(solver, !std::isnan(summary.residual), message.str(), solution);
}

}  // namespace airybench
