// What is asked of a case, besides its problem and its method: plain data. control_of() makes what
// the method is told from it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "support/status.hpp"

namespace airybench {

class Deadline;
struct Method;
struct RunControl;
struct Solution;

struct CaseSettings {
  Stop stop = Stop::target;
  double target_error = 1e-6;
  int threads = 1;  // of BLAS, and for right-hand sides
  // The tolerance of an iterative method is tightened until its own estimate is below the target.
  bool tightened = true;
  // Of the method's iteration; empty: the method's own, or found by tightening.
  std::optional<double> tolerance;
  std::optional<int> max_iterations;
  // Of the condensed contact problem. In a planned case no solver: there is no such problem.
  std::optional<ContactSolver> contact;
  std::optional<double> contact_tolerance;
  std::optional<int> max_contact_iterations;
  bool timed_once = false;
  bool histories = false;       // keep iteration histories
  bool condition = false;       // estimate the condition number of the factorised matrix
  bool in_eight_steps = false;  // also solve a load case in which faces slip in so many load steps
  bool intervals = false;       // bound the contact forces (with stresses of degree > 1 always)
  bool fields = false;          // write stresses, displacements, contact points …
  bool picture = false;         // … and the points of a part's picture (part_picture.hpp)
  std::vector<Eigen::Vector2d> points_mm = {};  // … and stress and displacement there
  bool mean_fields = false;  // … and their mean with the stresses of displacements
  // The total error of degree 1 comes from the displacements of P2; false: from recovered ones.
  bool total_error_by_displacements = false;
  std::string stresses_by = "HYBRID";  // the method whose stresses recovery starts from
};

RunControl control_of(const CaseSettings& settings, const Deadline& deadline);

// The tolerance of an iterative method is that of its first run, and then, as long as its own
// error estimate is above the target, the next, for so many runs; not below the tightest.
inline constexpr double tightest_tolerance = 1e-15;
inline constexpr int max_tightenings = 6;
double first_tolerance(const Method& method, const CaseSettings& settings);
double next_tolerance(double tolerance, const Solution& solution, const CaseSettings& settings);

}  // namespace airybench
