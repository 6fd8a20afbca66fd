// Solve, estimate, mark, bisect: a mesh made fine where the error is.
//
//   σ by an equilibrium method, with it an admissible displacement by local work
//   (displacement_recovery.hpp) and the constitutive relation error e; longest-edge bisection
//   (bisection.hpp) where the triangles' parts of e² are large; and again.
//
// A level costs a solve, and most of the time goes into the last: so there are few, each several
// times as fine as the one before. Triangles are cut until none of their parts is expected above a
// threshold (expected_parts.hpp), which is as high as the goal allows; where that is far off, at so
// many triangles that equal steps of at most a factor of four lead there, the first one of at most
// two. What was expected of the last level and what became of it, in triangles and in e², corrects
// what is expected of the next.
//
// A path of load steps is solved whole on every level, and marked by the sum of e² over its steps;
// its error is √(Σ e² / Σ ‖σ‖²).
//
// With a marking share, bulk marking instead: the triangles that hold this share of e². A marked
// triangle is cut 1 + ⌊log₄(its part / the least marked part)⌋ times: a cut divides the part by
// eight where the solution is smooth and by two to four at corners, and what sticks out far need
// not wait for as many levels. Where few triangles are marked, at corners, all of them are cut more
// often, as long as that adds less than about a tenth of the triangles: a level costs a solve. The
// last levels mark less when e ~ 1/N says that the goal would be passed.
#pragma once

#include <functional>

#include "assembly/scene.hpp"
#include "bench/plan/options.hpp"
#include "bench/verify/discretisation_error.hpp"
#include "bench/verify/expected_parts.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct AdaptiveSettings {
  std::vector<AdaptGoal> goals;  // one after the other
  // 0 < marking ≤ 1; 1: every triangle into four alike, once a level; empty: by expectation.
  std::optional<double> marking;
  double timeout_s = 900;                          // of one solve
  std::optional<std::int64_t> memory_limit_bytes;  // of one solve
  int threads = 1;
};

struct AdaptiveLevel {
  Mesh mesh;
  int number = 0;    // 0: the mesh it began with
  int unknowns = 0;  // n_φ
  // e / ‖σ‖, of a path over its steps; empty: the fields say nothing, see why_ended().
  std::optional<double> error;
  bool reaches_goal = false;  // one that no level before did
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
  bool reached() const { return goal_ == settings_.goals.size(); }  // all goals
  const std::string& why_ended() const { return ended_; }           // before it; else empty

 private:
  // Of all load steps: e² and ‖σ‖² summed.
  struct StepErrors {
    std::vector<double> of_triangle_Nmm;
    double squared_Nmm = 0, of_stress_Nmm = 0;
    std::string flaw;
    void add(const ConstitutiveError& error, const std::string& prefix);
    double relative() const;
  };
  void judge_step(const std::string& prefix, const DualSystem& system, const Solution& solution,
                  StepErrors& errors);
  bool refine();
  BisectedMesh marked_and_bisected() const;
  BisectedMesh bisected_as_expected();
  void judge_progress(AdaptiveLevel& level);

  Scene scene_;
  Mesh mesh_;
  Method method_;
  AdaptiveSettings settings_;
  std::vector<double> parts_Nmm_;  // of e², per triangle of the mesh
  MeshEdges edges_;                // of the mesh
  double squared_Nmm_ = 0;         // e²
  // Of the last refinement: what was expected, without corrections, and actual over expected.
  ExpectedParts::Finer expected_;
  double more_triangles_ = 1.2, more_squared_ = 1;
  std::vector<std::pair<int, double>> history_;  // per level: unknowns, error
  double time_s_ = 0, estimate_s_ = 0;
  std::size_t goal_ = 0;  // the first that is not reached
  std::string ended_;
};

}  // namespace airybench
