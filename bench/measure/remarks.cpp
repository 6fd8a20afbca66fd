#include "bench/measure/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "assembly/rigid_contact.hpp"

namespace airybench {
namespace {

// Of a load step, where it is gone in two halves.
struct StepChange {
  int points;       // largest change of the number that stick, or slip
  double of_force;  // of the resultant, relative; to a thousandth of the path's largest at least
  Eigen::Vector2d F, F_halved;
  bool is_seen() const { return points > 0 || of_force > 0.01; }
};

std::vector<StepChange> changes_in_halves(const std::vector<StepResult>& steps,
                                          const std::vector<StepResult>& halves) {
  constexpr double least = 1e-3;
  const auto resultant = [](const StepResult& step) {
    return Eigen::Vector2d(step.normal_resultant_N.value(), step.tangential_resultant_N.value());
  };
  double largest = 0;
  for (const StepResult& step : steps) largest = std::max(largest, resultant(step).norm());
  std::vector<StepChange> changes;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const StepResult &step = steps[k], &halved = halves[k];
    const auto change_of = [&](const auto& count) {
      return static_cast<int>(std::abs((step.*count).value() - (halved.*count).value()));
    };
    const Eigen::Vector2d F = resultant(step), F_halved = resultant(halved);
    const double scale = std::max(F_halved.norm(), least * largest);
    changes.push_back({std::max(change_of(&StepResult::n_stick), change_of(&StepResult::n_slip)),
                       scale > 0 ? (F - F_halved).norm() / scale : 0, F, F_halved});
  }
  return changes;
}

// At the start, middle or end of a contact edge, before it deforms.
double gap_mm_at(const Problem& problem, int row, int node) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const Eigen::Vector2d &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  return problem.offset_at(a + node * (b - a) / 2, row)
      .along(problem.frame_at(row, node, 2).normal)
      .x();
}

std::string remark_on_dissipation(const std::vector<StepResult>& steps,
                                  const std::vector<StepResult>& halves) {
  constexpr double seen = 0.02;
  constexpr double min_share = 1e-3;  // of the path's largest strain energy: less is no loss
  double own = 0, halved = 0, energy = 0;
  const auto add_up = [&](const std::vector<StepResult>& of, double& sum) {
    for (const StepResult& step : of) {
      sum += step.dissipation_Nmm.value();
      energy = std::max(energy, step.strain_energy_Nmm.value());
    }
  };
  add_up(steps, own);
  add_up(halves, halved);
  constexpr double of_rounding = 1e-9;
  for (double* sum : {&own, &halved})
    if (std::abs(*sum) < of_rounding * energy) *sum = 0;
  if (!(std::abs(own - halved) > seen * std::max({own, halved, min_share * energy}))) return "";
  return fmt::format(
      "with every load step in two halves friction dissipates {:.3g} N mm, not {:.3g}", halved,
      own);
}

}  // namespace

std::string words_of_least_gap(const Problem& problem) {
  if (!problem.later_steps.empty()) return "";  // of each step another
  double min_mm = std::numeric_limits<double>::infinity();
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
    const int other = problem.opposite_of(row);
    for (int node = 0; node < 3; ++node) {
      const double beyond = other == Problem::no_row ? 0 : gap_mm_at(problem, other, 2 - node);
      min_mm = std::min(min_mm, gap_mm_at(problem, row, node) + beyond);
    }
  }
  if (std::isinf(min_mm)) return "";
  return fmt::format("; the least gap, before anything deforms, is {:.3g} mm", min_mm);
}

std::vector<std::string> remarks_on_what_is_idle(const Problem& first, const Verification& v) {
  const Problem problem = problem_of_step(first, static_cast<int>(first.later_steps.size()));
  std::vector<std::string> remarks;
  const MeshSizes sizes = mesh_sizes(problem.mesh);
  if (sizes.contact_edges + sizes.force_edges == 0) {
    remarks.emplace_back("the whole boundary is prescribed");
  } else if (sizes.contact_edges == 0) {
    remarks.emplace_back("there is no contact boundary");
  } else if (const int points = v.n_open.value_or(0);
             points > 0 && v.n_stick.value_or(0) + v.n_slip.value_or(0) == 0) {
    remarks.push_back(fmt::format("nothing touches the {}: all {} contact points are open{}",
                                  obstacle_of(problem), points, words_of_least_gap(first)));
  }
  if (!problem.free.motions.empty())
    remarks.push_back(words_of_open_motions(rigid_contact(problem)));
  return remarks;
}

std::vector<std::string> remarks_on_half_steps(const std::vector<StepResult>& steps,
                                               const std::vector<StepResult>& halves, int whole) {
  const bool all_ok = std::ranges::all_of(
      halves, [](const StepResult& step) { return step.claimed_status == Status::ok; });
  if (halves.size() != steps.size() || !all_ok)
    return {"with every load step in two halves there is no answer to compare with"};
  std::vector<std::string> remarks = {remark_on_dissipation(steps, halves)};
  const std::vector<StepChange> changes = changes_in_halves(steps, halves);
  const auto differs = std::ranges::count_if(changes, &StepChange::is_seen);
  if (whole > 0 && (differs > 0 || !remarks.front().empty()))
    remarks.push_back(
        fmt::format("not halved: {} of the steps, with other supports than the one before", whole));
  if (differs == 0) return remarks;
  const auto worst = std::ranges::max_element(changes, {}, [](const StepChange& change) {
    return std::pair(change.points, change.of_force);
  });
  const auto& [points, of_force, F, F_halved] = *worst;
  const std::size_t k = worst - changes.begin();
  const StepResult &step = steps[k], &half = halves[k];
  remarks.push_back(
      fmt::format("with every load step in two halves {} of {} steps end otherwise, step {} most: "
                  "{} points stick and {} slip, not {} and {}; F = ({:.5g}, {:.5g}) N, not "
                  "({:.5g}, {:.5g})",
                  differs, changes.size(), k + 1, *half.n_stick, *half.n_slip, *step.n_stick,
                  *step.n_slip, F_halved.x(), F_halved.y(), F.x(), F.y()));
  return remarks;
}

std::string remark_on_polygons(const Method& method, const std::string& polygons,
                               const TotalError& total) {
  if (polygons.empty()) return "";
  // P2's to P4's error is to stresses that follow the curves: η is not of their chords alone.
  const bool is_of_chords = !method.in_displacements() || method.takes_chords();
  return fmt::format(
      "curves that are solved as polygons: {}{}", polygons,
      !total.of_mesh() || !(total.geometry() > 0) ? ""
      : is_of_chords
          ? fmt::format("; its total error contains η = {:.2g} % for them", 100 * total.geometry())
          : "; its total error contains that");
}

std::string remark_on_large_strains(const Problem& problem, const StressField& stress) {
  constexpr double largest_small = 0.1;
  double largest = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    // Means over triangles: corners are singular on any mesh.
    const Eigen::Vector3d strain = problem.compliance_of(t) * stress[t].rowwise().mean();
    const double middle = (strain(0) + strain(1)) / 2,
                 radius = std::hypot((strain(0) - strain(1)) / 2, strain(2) / 2);
    largest = std::max(largest, std::abs(middle) + radius);
  }
  if (!(largest > largest_small)) return "";
  return fmt::format(
      "strains of up to {:.2g} %: small strains, which all of this assumes, do not hold",
      100 * largest);
}

}  // namespace airybench
