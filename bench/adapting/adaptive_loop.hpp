// Solve, estimate, mark, bisect: a mesh made fine where the error is.
//
//   σ by an equilibrium method, with it an admissible displacement by local work
//   (displacement_recovery.hpp) and the constitutive relation error e; the triangles that hold the
//   marking fraction of e²; their longest-edge bisection (bisection.hpp); and again.
//
// A marked triangle is cut 1 + ⌊log₄(its part / the least marked part)⌋ times: a cut divides the
// part by eight where the solution is smooth and by two to four at corners, and what sticks out far
// need not wait for as many levels. Where few triangles are marked, at corners, all of them are cut
// more often, as long as that adds less than about a tenth of the triangles: a level costs a solve.
// The last levels mark less when e ~ 1/N says that the goal would be passed.
#pragma once

#include <functional>

#include "assembly/scene.hpp"
#include "bench/cases/adapt_goal.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct AdaptiveSettings {
  AdaptGoal goal;
  double marking = default_marking;                // 0 < marking ≤ 1
  double timeout_s = 900;                          // of one solve
  std::optional<std::int64_t> memory_limit_bytes;  // of one solve
  int threads = 1;
};

struct AdaptiveLevel {
  Mesh mesh;
  int number = 0;               // 0: the mesh it began with
  int unknowns = 0;             // n_φ
  std::optional<double> error;  // e / ‖σ‖; empty: the fields say nothing, see why_ended()
  double smallest_angle_deg = 0;
  double time_s = 0, estimate_s = 0;  // of all levels up to this one, and what the estimates took
};

class AdaptiveLoop {
 public:
  // The scene changes no mesh: it is posed on every level. The method returns edge moments; the
  // first next() throws UsageError where it does not.
  AdaptiveLoop(Scene scene, Mesh mesh, Method method, AdaptiveSettings settings);

  // The next level, solved and judged; empty when the loop has ended.
  std::optional<AdaptiveLevel> next();
  bool reached() const { return reached_; }                // the goal, by the last level
  const std::string& why_ended() const { return ended_; }  // before it; else empty

 private:
  bool refine();
  void judge_progress(const AdaptiveLevel& level);

  Scene scene_;
  Mesh mesh_;
  Method method_;
  AdaptiveSettings settings_;
  std::vector<double> parts_Nmm_;                // of e², per triangle of the mesh
  std::vector<std::pair<int, double>> history_;  // per level: unknowns, error
  double time_s_ = 0, estimate_s_ = 0;
  bool reached_ = false;
  std::string ended_;
};

}  // namespace airybench
