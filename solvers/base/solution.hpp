// What a method returns, and what it is told.
#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "assembly/stress_field.hpp"
#include "solvers/base/stage_times.hpp"
#include "support/memory_owner.hpp"
#include "support/status.hpp"

namespace airybench {

namespace contact {
struct Problem;
}
struct ContactResult;
struct ContactSystem;
struct RunControl;

struct IterationHistory {
  std::string what;              // "natural map residual of the contact sweeps"
  std::vector<double> residual;  // one per iteration
};

// Of a solve by another program.
struct ProgramRun {
  double wall_s = 0;            // from its start to its end
  double processor_s = 0;       // the same, of all its threads and processes
  double solve_s = 0;           // its solve, by its own clock
  double not_solve_s = 0;       // part of our time that its own clock leaves out: start-up, files
  std::int64_t peak_bytes = 0;  // resident, of it and its child processes
  std::string log;              // its log for the reader
};

// Wall clock of an iteration's pieces, in whatever stage it ran.
struct IterationTimes {
  double matrix_s = 0;    // products with the matrix
  double smoother_s = 0;  // sweeps of its preconditioner
  double coarse_s = 0;    // its coarse problem, and what goes to it and back
};

// What a method solves for, by kind. The Airy function, as airy_function() gives it:
struct AiryFunction {
  Eigen::VectorXd phi;
};
// The moments ū_j (equilibrium_element.hpp) of w on every edge; rows: x and y of each, from the low
// vertex on; mm.
struct EdgeDisplacements {
  Eigen::MatrixXd moments;
};
// Of another program: how its displacements may differ from ours.
struct ProgramTolerances {
  double print_precision = 0;      // largest relative rounding of its numbers; 0: of doubles
  double allowed_penetration = 0;  // relative to the largest displacement
  bool weak_contact = false;       // its contact law also loads inner nodes next to Γ_C
  // Its elements are not quadratic, its forces not those of our nodes: the total error alone
  // judges.
  bool other_elements = false;
};
// A DisplacementField w (displacement_field.hpp) of one degree more than the stresses, without the
// problem's rigid motion, mm.
struct Displacements {
  Eigen::Matrix2Xd w;
  std::optional<ProgramTolerances> by_program = {};
};

// The defaults are those of a method that never ran.
struct Solution {
  Status status = Status::crashed;
  std::string message = "the method returned nothing";
  // Contact forces, N; per point normal, tangential (μ = 0: normal). At the contact points; a
  // displacement method's are at its control points (control_points.hpp).
  Eigen::VectorXd F_C;
  Eigen::VectorXd contact_displacement;  // ū_C that belongs to them, mm; in the rows of F_C
  // Of pieces that contact alone holds (free_motions.hpp); empty: there is none, or it is known.
  // ū_C and displacements are those of the pinned pieces, without it.
  Eigen::VectorXd free_motion_mm;
  std::variant<std::monostate, AiryFunction, EdgeDisplacements, Displacements> unknowns;
  StressField stress;  // MPa
  StageTimes times;
  // Counted by the method as entries × size: what it holds between stages, and the vectors of its
  // iteration. Without the blocks.
  ByOwner<std::size_t> storage;
  std::size_t file_bytes = 0;  // more of its matrices, in a file
  // Of its factor or preconditioner: non-zeros, and the additions and multiplications of the
  // numeric factorisation.
  std::optional<std::int64_t> factor_entries;
  std::optional<double> factor_flops;
  std::optional<std::int64_t> linear_iterations;  // of all right-hand sides
  std::optional<int> contact_iterations;          // of the contact solver; Newton's: its sweeps
  std::optional<int> newton_steps;                // active sets of the contact law
  std::optional<int> uzawa_iterations;
  std::optional<IterationTimes> iteration_times;  // two levels only
  std::vector<IterationHistory> histories;
  std::string parameters;  // chosen or changed by the method: "r=20, rho=32", "shift=0.002"
  std::optional<double> done_fraction;  // on timeout, where known
  // The method's own estimate of the largest relative error that the verifier measures.
  std::optional<double> error_estimate;
  std::optional<double> condition_estimate;  // of the equilibrated matrix it factorises, 1-norm
  std::optional<ProgramRun> program;
  // With RunControl::keep_body, where the method can: solves another load case of the same body
  // with the factor and D of this solve, which it owns (kept_body.hpp).
  std::function<Solution(const ContactSystem& load_case, const RunControl&)> solve_again;

  template <typename Kind>
  const Kind* as() const {  // null: its unknowns are of another kind
    return std::get_if<Kind>(&unknowns);
  }
};

// On the heap and in files, without the vectors of an iteration.
std::size_t matrix_bytes(const Solution& solution);

// Thrown when time is up; the runner of methods turns it into Status::timeout.
struct TimeoutReached : std::runtime_error {
  explicit TimeoutReached(const std::string& message, std::optional<double> done = {},
                          std::optional<double> error = {})
      : std::runtime_error(message), done_fraction(done), error_so_far(error) {}
  // Turns the fraction of one right-hand side into that of all, `others` being done before it.
  void count_before(int others) {
    if (done_fraction) done_fraction = (others + *done_fraction) / (others + 1);
  }
  std::optional<double> done_fraction;  // of the work, 0 … 1, where known
  std::optional<double> error_so_far;   // the relative residual that was reached
};
// A numerical dead end inside a kernel; the runner of methods turns it into Status::breakdown.
struct Breakdown : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A cooperative time limit, checked between right-hand sides, panels and iterations.
class Deadline {
 public:
  Deadline() = default;  // none
  // While true, every deadline of the process has passed. A signal handler may set it.
  static inline std::atomic<bool> all_passed = false;
  static Deadline after(double seconds) {
    constexpr double never = 1e9;  // the clock's integers end soon after
    Deadline deadline;
    if (seconds > never) return deadline;
    deadline.end_ = std::chrono::steady_clock::now() +
                    std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                        std::chrono::duration<double>(seconds));
    return deadline;
  }
  bool passed() const {
    return all_passed.load(std::memory_order_relaxed) ||
           (end_ && std::chrono::steady_clock::now() > *end_);
  }
  double remaining_s() const {  // infinity: there is none
    if (!end_) return std::numeric_limits<double>::infinity();
    return std::chrono::duration<double>(*end_ - std::chrono::steady_clock::now()).count();
  }
  void check(std::string_view doing) const {
    if (passed()) throw TimeoutReached("time limit reached during " + std::string(doing));
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> end_;
};

// Of the solvers of a condensed contact law (condensed.hpp).
struct ContactOptions {
  ContactSolver solver = ContactSolver::newton;
  double tolerance = 1e-12;  // ‖natural map‖ ≤ tolerance · ‖F_C‖
  double acceptable = 1e-12;  // ‖natural map‖ ≤ acceptable · ‖F_C‖, when iterations have ended
  int max_iterations = 100000;  // sweeps, where the solver makes these
  bool history = false;
  Eigen::VectorXd start = {};  // contact forces, N; empty: zero
  // Another's contact solver, instead of ours.
  std::function<ContactResult(const contact::Problem&)> by = {};
};

// What a method is told. It makes the options of its solvers from this.
struct RunControl {
  Deadline deadline;
  bool histories = false;  // keep iteration histories
  bool condition = false;  // estimate it, where the method does: a few more solves
  bool keep_body = false;  // for other load cases; the deadline then is one for all of them
  int threads = 1;         // for right-hand sides in parallel
  Stop stop = Stop::target;
  double target_error = 1e-6;  // error_estimate ≤ target_error, or the method says `inaccurate`
  // Of the method's iteration: KrylovOptions, RowsOptions, UzawaOptions.
  double tolerance = 1e-10;
  std::optional<int> max_iterations = {};  // Krylov's per right-hand side, Uzawa's; else their own
  ContactOptions contact = {};             // with the paper's stop its solver is Gauss–Seidel
};

// After an iteration that has not converged: not_converged with this message, but a breakdown where
// what is iterated is not finite.
void stop_unconverged(const std::string& iteration, bool is_finite, const std::string& message,
                      Solution& solution);

// Stores the estimate; the status is `inaccurate` where it is above the target.
void judge_by_own_estimate(double estimate, const RunControl& control, Solution& solution);

}  // namespace airybench
