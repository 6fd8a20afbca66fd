#include "bench/run/adaptive_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "assembly/problem/matched_faces.hpp"
#include "assembly/problem/pose.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/measure/load_step_runs.hpp"
#include "mesh/bisection.hpp"
#include "mesh/refinement.hpp"
#include "mesh/transform.hpp"
#include "support/seconds_since.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench {
namespace {

// Limits the correction that one level makes to the expectation for the next.
constexpr double max_correction = 3;
constexpr int max_cuts = 24;  // per triangle and level

std::vector<int> cuts_of(const std::vector<double>& parts, double marking) {
  constexpr double part_of_a_cut = 4;
  constexpr double cheap = 0.1;  // a level may always add this share of the triangles
  std::vector<int> cuts(parts.size(), 0);
  const std::vector<int> marked = bulk_marks(parts, marking);
  double least = std::numeric_limits<double>::infinity();
  for (const int t : marked) least = std::min(least, parts[t]);
  for (const int t : marked)
    cuts[t] = 1 + static_cast<int>(std::log(parts[t] / least) / std::log(part_of_a_cut));
  const auto born = [&] {
    double count = 0;
    for (const int t : marked) count += std::exp2(cuts[t]) - 1;
    return count;
  };
  while (!marked.empty() && 2 * born() < cheap * static_cast<double>(parts.size()))
    for (const int t : marked) ++cuts[t];
  return cuts;
}

}  // namespace

AdaptiveLoop::AdaptiveLoop(Scene scene, Mesh mesh, Method method, AdaptiveSettings settings)
    : scene_(std::move(scene)),
      mesh_(std::move(mesh)),
      method_(std::move(method)),
      settings_(std::move(settings)) {}

std::optional<AdaptiveLevel> AdaptiveLoop::next() {
  if (reached() || !ended_.empty()) return {};
  const auto start = std::chrono::steady_clock::now();
  AdaptiveLevel level;
  if (!history_.empty()) {
    const SecondsInto timer(level.times.refine_s);
    if (!refine()) return {};
  }
  const auto posing = std::chrono::steady_clock::now();
  const auto problem = std::make_shared<const Problem>(pose(scene_, mesh_));
  ContactSystem system = contact_system(problem, method_.degree);
  level.times.pose_s = seconds_since(posing);

  RunControl control;
  control.deadline = Deadline::after(settings_.timeout_s);
  control.threads = settings_.threads;
  std::optional<heap::Limit> limit;
  const auto set_limit = [&, least = heap::live_bytes()] {
    if (settings_.memory_limit_bytes) limit.emplace(least + *settings_.memory_limit_bytes);
  };
  set_limit();
  TotalError error;
  const auto solving = std::chrono::steady_clock::now();
  const std::vector<bool> candidates = std::exchange(closed_, {}).candidates(problem->mesh);
  solve_load_steps(on_candidates(method_.solve, *problem, candidates), system, control,
                   [&](int step, const ContactSystem& posed, const Solution& answer) {
                     const SecondsInto timer(level.times.estimate_s);
                     limit.reset();
                     add_times(answer.times, level.times.stages);
                     judge_step(step, *problem, posed, answer, error);
                     if (settings_.keeps_answers) level.answers.push_back({posed, answer});
                     set_limit();
                   });
  limit.reset();
  level.times.solve_s = seconds_since(solving) - level.times.estimate_s;
  if (!ended_.empty()) return {};
  time_s_ += seconds_since(start);
  level.mesh = mesh_;
  level.number = static_cast<int>(history_.size());
  level.unknowns = mesh_sizes(mesh_).n_phi;
  level.time_s = time_s_;
  level.error = error.relative();
  if (!error.flaw().empty()) ended_ = "nothing can be said of the error: " + error.flaw();
  level.parts = parts_ = error.parts();
  of_chords_ = error.parts_of_chords();
  squared_ = std::accumulate(parts_.begin(), parts_.end(), 0.0);
  edges_ = problem->edges;
  if (expected_.squared > 0)
    more_squared_ = std::sqrt(  // most of what was missed was seen on the way
        std::clamp(squared_ / expected_.squared, 1 / max_correction, max_correction));
  judge_progress(level);
  return level;
}

void AdaptiveLoop::judge_step(int step, const Problem& path, const ContactSystem& system,
                              const Solution& solution, TotalError& error) {
  const std::string prefix = step_prefix(static_cast<std::size_t>(step), path);
  if (solution.status != Status::ok) {
    ended_ = fmt::format("{} on {} unknowns: {}{}: {}", method_.name, mesh_sizes(mesh_).n_phi,
                         prefix, name_of(solution.status), solution.message);
    return;
  }
  closed_.add(system, solution);
  const DisplacementField w = recovered_displacement(system, solution);
  const ConstitutiveError of_step = constitutive_error(system, solution.stress, solution.F_C, w);
  error.add(of_step, prefix);
  if (settings_.stress_error && step == std::ssize(path.later_steps)) {
    const SolvedFields fields{system, solution, w, &of_step, nullptr, {}};
    doubt_ = of_step.flaw.empty() ? stress_doubt(fields) : std::nullopt;
  }
}

bool AdaptiveLoop::knows_largest_stress() const {
  constexpr double min_gain = 0.9;
  constexpr std::size_t max_levels = 5;
  return !doubt_ || doubt_->relative <= *settings_.stress_error || doubts_.size() >= max_levels ||
         (!doubts_.empty() && doubt_->relative > min_gain * doubts_.back());
}

bool AdaptiveLoop::is_met(const AdaptGoal& goal, const AdaptiveLevel& level) const {
  return goal.error ? *level.error <= *goal.error && knows_largest_stress()
                    : level.unknowns >= *goal.unknowns;
}

void AdaptiveLoop::judge_progress(AdaptiveLevel& level) {
  constexpr int growth = 8;
  constexpr double min_gain = 0.9;
  if (!level.error) return;
  for (; !reached() && is_met(settings_.goals[goal_], level); ++goal_)
    level.goal = settings_.goals[goal_];
  history_.emplace_back(level.unknowns, *level.error);
  if (!reached() && *level.error == 0) ended_ = "the error is zero: there is nothing to refine";
  for (const auto& [unknowns, before] : history_)
    if (!reached() && level.unknowns >= growth * unknowns && *level.error > min_gain * before)
      ended_ = fmt::format("{} times the unknowns have not lowered the error of {:.2g} %", growth,
                           100 * before);
}

BisectedMesh AdaptiveLoop::marked_and_bisected() const {
  constexpr double margin = 1.1, step = 0.85, min_marking = 0.1;
  const AdaptGoal& goal = settings_.goals[goal_];
  const auto& [unknowns, error] = history_.back();
  const double rate = 2. / (method_.degree + 1);  // e ~ N^−(k+1)/2
  const double needed =
      goal.error ? margin * unknowns * std::pow(error / *goal.error, rate) : *goal.unknowns;
  double marking = *settings_.marking;
  BisectedMesh finer = bisected(mesh_, cuts_of(parts_, marking));
  while (mesh_sizes(finer.mesh).n_phi > needed && marking > min_marking) {
    BisectedMesh smaller = bisected(mesh_, cuts_of(parts_, marking *= step));
    if (mesh_sizes(smaller.mesh).n_phi < needed) break;
    finer = std::move(smaller);
  }
  return finer;
}

BisectedMesh AdaptiveLoop::bisected_as_expected() {
  // Growth in triangles per level; the first level only locates singular vertices.
  constexpr double max_growth = 4, first_growth = 2, min_growth = 1.2;
  constexpr double aim = 0.96;  // of the goal: a near miss costs one more level
  using Finer = ExpectedParts::Finer;
  const AdaptGoal& goal = settings_.goals[goal_];
  const ExpectedParts expected(mesh_, edges_, parts_, method_.degree, of_chords_);
  const auto triangles = static_cast<double>(mesh_.triangles.size());
  const auto& [unknowns, error] = history_.back();
  const auto with_neighbours = [&](const Finer& finer) {
    return triangles + more_triangles_ * (finer.triangles - triangles);
  };
  const auto is_enough = [&](const Finer& finer, double count) {
    return with_neighbours(finer) >= count || finer.triangles > max_triangles;
  };
  const auto until = [&](double count) {
    return expected.cut_until([&](const Finer& finer) { return is_enough(finer, count); });
  };
  if (goal.error) {
    const double left = std::pow(aim * *goal.error / error, 2) * squared_;
    expected_ = expected.cut_until([&](const Finer& finer) {
      return is_enough(finer, min_growth * triangles) &&
             (more_squared_ * finer.squared <= left || finer.triangles > max_triangles);
    });
  } else {
    expected_ = until(triangles * *goal.unknowns / unknowns / aim);
  }
  const double growth = with_neighbours(expected_) / triangles,
               steps = std::ceil(std::log(growth) / std::log(max_growth));
  const double first = history_.size() == 1 ? first_growth : max_growth;
  if (steps > 1 || growth > first)
    expected_ = until(triangles * std::min(first, std::pow(growth, 1 / steps)));
  BisectedMesh finer = bisected(mesh_, [&](const TrianglePart& part) {
    return part.cuts < max_cuts && expected.of(part) > expected_.largest;
  });
  const double born = static_cast<double>(finer.mesh.triangles.size()) - triangles;
  more_triangles_ = std::clamp(born / (expected_.triangles - triangles), 1., max_correction);
  return finer;
}

BisectedMesh AdaptiveLoop::bisected_at_largest_stress() {
  constexpr int cuts_to_halve = 2;
  doubts_.push_back(doubt_->relative);
  expected_ = {};
  std::vector<bool> is_near(mesh_.vertices.size(), false);
  for (const int t : doubt_->triangles)
    for (const int v : mesh_.triangles[t]) is_near[v] = true;
  std::vector<int> cuts(mesh_.triangles.size(), 0);
  for (std::size_t t = 0; t < cuts.size(); ++t)
    if (std::ranges::any_of(mesh_.triangles[t], [&](int v) { return is_near[v]; }))
      cuts[t] = cuts_to_halve;
  return bisected(mesh_, cuts);
}

// Where a contact edge has been cut, so is the one that it faces.
BisectedMesh AdaptiveLoop::cut_opposite_edges(BisectedMesh finer) const {
  constexpr int max_passes = 20;  // then the edges' triangles are split instead
  for (int pass = 0; pass < max_passes && !scene_.contacts.empty(); ++pass) {
    const std::vector<int> rows = with_matched_faces(finer.mesh, scene_).split_rows;
    if (rows.empty()) break;
    const MeshEdges edges = number_edges(finer.mesh);
    std::vector<int> cuts(finer.mesh.triangles.size(), 0);
    std::vector<bool> is_due(static_cast<std::size_t>(edges.count()), false);
    for (const int row : rows) is_due[edges.of_boundary[row]] = true;
    for (std::size_t t = 0; t < cuts.size(); ++t)
      for (const int edge : edges.of_triangle[t]) cuts[t] |= is_due[edge] ? 1 : 0;
    finer = bisected(finer.mesh, cuts);
  }
  return finer;
}

bool AdaptiveLoop::refine() {
  BisectedMesh finer;
  if (const auto& error = settings_.goals[goal_].error; error && history_.back().second <= *error)
    finer = bisected_at_largest_stress();
  else if (!settings_.marking)
    finer = bisected_as_expected();
  else if (*settings_.marking < 1)
    finer = marked_and_bisected();
  else
    finer.mesh = uniformly_refined(mesh_);
  finer = cut_opposite_edges(std::move(finer));
  if (finer.mesh.triangles.size() > max_triangles)
    ended_ = fmt::format("the next mesh would have more than {} triangles", max_triangles);
  else if (finer.mesh.triangles.size() == mesh_.triangles.size())
    ended_ = "the marked triangles are too small for their points to be told apart";
  else
    mesh_ = std::move(finer.mesh);
  return ended_.empty();
}

}  // namespace airybench
