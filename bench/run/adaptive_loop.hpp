// Adaptive refinement: solve, estimate, mark, bisect.
//
//   σ by an equilibrium method; from it an admissible displacement by local problems
//   (displacement_recovery.hpp) and the constitutive relation error e; longest-edge bisection
//   (bisection.hpp) of the triangles with the largest parts of e².
//
// Each level costs a solve, so levels are few and grow by large factors. Triangles are cut until
// every part is expected to be below a threshold (expected_parts.hpp), the highest that meets the
// goal. If the goal is far away, levels grow by equal factors of at most four, the first by at most
// two. The ratio of actual to expected, in triangles and in e², corrects the next expectation.
//
// A marking share selects bulk marking instead: the triangles that hold this share of e². A marked
// triangle is cut 1 + ⌊log₄(its part / the least marked part)⌋ times; a cut divides the part by
// eight where the solution is smooth, by two to four at corners. Few marked triangles are cut more
// often, which adds at most a tenth of the triangles. The last levels mark less if e ~ 1/N predicts
// an overshoot.
//
// From the second level on the contact law is formed near edges that had force on the level before
// (contact_candidates.hpp).
//
// Where the error is met and the largest stress is not known as well as asked for, the triangles
// that may have it, and those around them, are halved in size.
#pragma once

#include <functional>

#include "assembly/problem/scene.hpp"
#include "bench/measure/part_answer.hpp"
#include "bench/plan/options.hpp"
#include "solvers/contact/contact_candidates.hpp"
#include "solvers/methods.hpp"
#include "verify/expected_parts.hpp"
#include "verify/total_error.hpp"

namespace airybench {

struct AdaptiveSettings {
  std::vector<AdaptGoal> goals;  // met in this order
  // 0 < marking ≤ 1; 1: uniform refinement; empty: cuts by expected parts.
  std::optional<double> marking = {};
  // An error that is a goal is met once the largest stress, if it is bounded, is not off by more
  // than this, relative (part_answer.hpp), or is no better known on finer meshes.
  std::optional<double> stress_error = {};
  double timeout_s = 900;                               // per solve
  std::optional<std::int64_t> memory_limit_bytes = {};  // per solve
  int threads = 1;
  bool keeps_answers = false;  // AdaptiveLevel::answers
};

// Of a load step.
struct StepAnswer {
  ContactSystem system;
  Solution solution;
};

// Seconds of one level; of its load steps the sums.
struct LevelTimes {
  double refine_s = 0, pose_s = 0;  // the mesh of this level; problem and system on it
  double solve_s = 0, estimate_s = 0;
  StageTimes stages = {};  // of solve_s
};

struct AdaptiveLevel {
  Mesh mesh;
  int number = 0;                 // 0: the initial mesh
  int unknowns = 0;               // n_φ
  std::optional<double> error;    // TotalError::relative(); empty: see why_ended()
  std::optional<AdaptGoal> goal;  // the last that it, and no earlier level, reaches
  double time_s = 0;              // of all levels so far
  LevelTimes times = {};
  std::vector<double> parts = {};        // of the squared error, per triangle
  std::vector<StepAnswer> answers = {};  // if they are kept
};

class AdaptiveLoop {
 public:
  // The scene is posed on every level, so it must not change the mesh. Unless the method returns
  // edge moments, the first next() throws UsageError.
  AdaptiveLoop(Scene scene, Mesh mesh, Method method, AdaptiveSettings settings);

  // Empty once the loop has ended.
  std::optional<AdaptiveLevel> next();
  bool reached() const { return goal_ == settings_.goals.size(); }  // all goals
  const std::string& why_ended() const { return ended_; }  // if not all are reached; else empty

 private:
  void judge_step(int step, const Problem& path, const ContactSystem& system,
                  const Solution& solution, TotalError& error);
  bool refine();
  BisectedMesh marked_and_bisected() const;
  BisectedMesh bisected_as_expected();
  BisectedMesh bisected_at_largest_stress();
  bool knows_largest_stress() const;
  bool is_met(const AdaptGoal& goal, const AdaptiveLevel& level) const;
  BisectedMesh cut_opposite_edges(BisectedMesh finer) const;
  void judge_progress(AdaptiveLevel& level);

  Scene scene_;
  Mesh mesh_;
  Method method_;
  AdaptiveSettings settings_;
  // Of the squared error, per triangle: all, and what chords in place of curves cost.
  std::vector<double> parts_, of_chords_;
  MeshEdges edges_;
  double squared_ = 0;                // their sum
  ClosedEdges closed_;                // of all load steps of the last level
  std::optional<StressDoubt> doubt_;  // of the last load step's largest stress
  std::vector<double> doubts_;        // of levels that were refined for it, relative
  // The last refinement: the uncorrected expectation, and the ratios of actual to expected.
  ExpectedParts::Finer expected_;
  double more_triangles_ = 1.2, more_squared_ = 1;
  std::vector<std::pair<int, double>> history_;  // per level: unknowns, error
  double time_s_ = 0;
  std::size_t goal_ = 0;  // the first that is not yet reached
  std::string ended_;
};

}  // namespace airybench
