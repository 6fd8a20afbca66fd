#include "bench/adapting/adaptive_loop.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "bench/heap/heap_probe.hpp"
#include "bench/judging/discretisation_error.hpp"
#include "bench/judging/displacement_recovery.hpp"
#include "bench/judging/marking.hpp"
#include "mesh/bisection.hpp"
#include "mesh/quality.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

// How often each triangle is to be cut (adaptive_loop.hpp).
std::vector<int> cuts_of(const std::vector<double>& parts, double marking) {
  constexpr double part_of_a_cut = 4;
  constexpr double cheap = 0.1;  // of the triangles, that a level may add at least
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

BisectedMesh refined(const Mesh& mesh, const std::vector<double>& parts, double marking) {
  return bisected(mesh, cuts_of(parts, marking));
}

}  // namespace

AdaptiveLoop::AdaptiveLoop(Scene scene, Mesh mesh, Method method, AdaptiveSettings settings)
    : scene_(std::move(scene)),
      mesh_(std::move(mesh)),
      method_(std::move(method)),
      settings_(settings) {}

std::optional<AdaptiveLevel> AdaptiveLoop::next() {
  if (reached_ || !ended_.empty()) return {};
  const auto start = std::chrono::steady_clock::now();
  if (!history_.empty() && !refine()) return {};
  const DualSystem system =
      assemble(std::make_shared<const Problem>(pose(scene_, mesh_)), Blocks::contact_points);

  RunControl control;
  control.deadline = Deadline::after(settings_.timeout_s);
  control.threads = settings_.threads;
  std::optional<heap::Limit> limit;
  if (settings_.memory_limit_bytes)
    limit.emplace(heap::live_bytes() + *settings_.memory_limit_bytes);
  const Solution solution = run(method_, system, control);
  limit.reset();
  if (solution.status != Status::ok) {
    ended_ = fmt::format("{} on {} unknowns: {}: {}", method_.name, mesh_sizes(mesh_).n_phi,
                         name_of(solution.status), solution.message);
    return {};
  }
  if (solution.edge_moments.cols() == 0)
    throw UsageError(fmt::format(
        "--adapt-by: {} (allowed: a method with edge displacements, as HYBRID)", method_.name));

  const auto estimating = std::chrono::steady_clock::now();
  const DisplacementField w =
      recovered_displacement(system, solution.stress, solution.F_C, solution.edge_moments);
  ConstitutiveError error = constitutive_error(system, solution.stress, solution.F_C, w);
  time_s_ += seconds_since(start);
  estimate_s_ += seconds_since(estimating);
  AdaptiveLevel level;
  level.mesh = mesh_;
  level.number = static_cast<int>(history_.size());
  level.unknowns = mesh_sizes(mesh_).n_phi;
  level.smallest_angle_deg = mesh_quality(mesh_).smallest_angle_deg;
  level.time_s = time_s_;
  level.estimate_s = estimate_s_;
  if (error.flaw.empty())
    level.error = error.relative;
  else
    ended_ = "nothing can be said of the error: " + error.flaw;
  parts_Nmm_ = std::move(error.of_triangle_Nmm);
  judge_progress(level);
  return level;
}

// Sets whether the goal is reached, and ends what gets nowhere.
void AdaptiveLoop::judge_progress(const AdaptiveLevel& level) {
  constexpr int growth = 8;
  constexpr double least_gain = 0.9;
  if (!level.error) return;
  reached_ = (settings_.goal.error && *level.error <= *settings_.goal.error) ||
             (settings_.goal.unknowns && level.unknowns >= *settings_.goal.unknowns);
  history_.emplace_back(level.unknowns, *level.error);
  for (const auto& [unknowns, before] : history_)
    if (!reached_ && level.unknowns >= growth * unknowns && *level.error > least_gain * before)
      ended_ = fmt::format("{} times the unknowns have not lowered the error of {:.2g} %", growth,
                           100 * before);
}

bool AdaptiveLoop::refine() {
  constexpr double margin = 1.1, step = 0.85, least_marking = 0.1;
  const auto& [unknowns, error] = history_.back();
  const double needed = settings_.goal.error
                            ? margin * unknowns * error / *settings_.goal.error  // e ~ 1/N
                            : *settings_.goal.unknowns;
  double marking = settings_.marking;
  BisectedMesh finer = refined(mesh_, parts_Nmm_, marking);
  while (mesh_sizes(finer.mesh).n_phi > needed && marking > least_marking) {
    BisectedMesh smaller = refined(mesh_, parts_Nmm_, marking *= step);
    if (mesh_sizes(smaller.mesh).n_phi < needed) break;
    finer = std::move(smaller);
  }
  if (finer.mesh.triangles.size() > most_triangles)
    ended_ = fmt::format("the next mesh would have more than {} triangles", most_triangles);
  else if (finer.mesh.triangles.size() == mesh_.triangles.size())
    ended_ = "the marked triangles are too small for their points to be told apart";
  else
    mesh_ = std::move(finer.mesh);
  return ended_.empty();
}

}  // namespace airybench
