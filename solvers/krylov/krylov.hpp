// What the Krylov solvers share: many right-hand sides, options, result.
//
// Each lane of a block runs the iteration for one right-hand side and takes the next one when it is
// done, so that a slow one does not hold up the others. What a right-hand side goes through does
// not depend on its neighbours: iteration counts are the same for any number of lanes or threads,
// up to rounding.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "solvers/base/lanes.hpp"
#include "solvers/base/parallel.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/preconditioners/preconditioner.hpp"

namespace airybench {

using LaneColumn = Eigen::Ref<Eigen::VectorXd, 0, Eigen::InnerStride<>>;

struct RightHandSides {
  int count = 0;
  std::function<void(int k, LaneColumn b)> load;          // b is zero on entry
  std::function<void(int k, const LaneColumn& x)> store;  // distinct k from several threads at once
};

// The columns of X, to be replaced by the solutions.
RightHandSides columns_of(Eigen::Ref<Eigen::MatrixXd> X);

struct KrylovOptions {
  double tolerance = 1e-10;     // ‖b − A x‖_M⁻¹ ≤ tolerance · ‖b‖_M⁻¹
  int max_iterations = 200000;  // per right-hand side
  int lanes = max_lanes;        // right-hand sides at once: 1 or max_lanes
  int threads = 1;              // each with lanes of its own
};

// Of the vectors of a solve for `count` right-hand sides, with `rows` rows per lane, including
// those of the preconditioner's operators.
std::size_t iteration_bytes(const KrylovOptions& options, int count, Eigen::Index rows);

struct KrylovSummary {
  bool converged = true;        // every right-hand side met the tolerance
  std::int64_t iterations = 0;  // of all right-hand sides together
  int max_iterations = 0;       // of one of them
  double residual = 0;          // largest relative one at the end, as the recurrence has it
  std::vector<double> history;  // relative residuals of the first right-hand side
  void add(const KrylovSummary& other);
};

KrylovOptions krylov_options(const RunControl& control);
// Iterations, history and, when the tolerance was not met, status and message into the solution.
void note_krylov(const char* solver, const KrylovSummary& summary, const KrylovOptions& options,
                 const RunControl& control, Solution& solution);

// Which right-hand side of a range is in which lane.
class Lanes {
 public:
  static constexpr int none = -1;
  Lanes(int begin, int end, int lanes)
      : begin_(begin), end_(end), next_(begin), in_lane_(static_cast<std::size_t>(lanes), none) {}

  int refill(int l) { return in_lane_[l] = next_ < end_ ? next_++ : none; }
  int operator[](int l) const { return in_lane_[l]; }
  bool any() const;
  // Throws TimeoutReached with what was done when time is up. residual: relative, per lane.
  void check_time(const Deadline& deadline, const char* solver, const LaneScalars& residual,
                  double tolerance) const;

 private:
  int begin_, end_, next_;
  std::vector<int> in_lane_;
};

// Adds up solve_range(begin, end, lanes), lanes a compile-time constant, over all threads.
template <typename SolveRange>
KrylovSummary solve_in_ranges(const KrylovOptions& options, int count, SolveRange solve_range) {
  KrylovSummary summary;
  std::mutex mutex;
  in_parallel(options.threads, count, [&](int begin, int end) {
    with_lanes(options.lanes, [&](auto lanes) {
      const KrylovSummary part = solve_range(begin, end, lanes);
      const std::lock_guard lock(mutex);
      summary.add(part);
    });
  });
  return summary;
}

}  // namespace airybench
