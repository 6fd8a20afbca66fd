#include "bench/measure/record_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "assembly/rigid_contact.hpp"
#include "bench/measure/heap_probe.hpp"
#include "solvers/base/method.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

void note(const std::optional<Bracket>& bracket, std::optional<double>& low,
          std::optional<double>& high) {
  if (!bracket) return;
  low = bracket->low;
  high = bracket->high;
}

// Of a load step, where it is gone in two halves.
struct StepChange {
  int points;       // largest change of the number that stick, or slip
  double of_force;  // of the resultant, relative; to a thousandth of the path's largest at least
  Eigen::Vector2d F, F_halved;
  bool is_seen() const { return points > 0 || of_force > 0.01; }
};

std::vector<StepChange> changes_in_halves(const Record& record) {
  constexpr double least = 1e-3;
  const auto resultant = [](const StepResult& step) {
    return Eigen::Vector2d(step.normal_resultant_N.value(), step.tangential_resultant_N.value());
  };
  double largest = 0;
  for (const StepResult& step : record.steps) largest = std::max(largest, resultant(step).norm());
  std::vector<StepChange> changes;
  for (std::size_t k = 0; k < record.steps.size(); ++k) {
    const StepResult &step = record.steps[k], &halved = record.steps_in_halves[k];
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

}  // namespace

AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem,
                                     const Method& method, int repetitions) {
  AssembledBlocks blocks;
  for (int i = 0; i < repetitions; ++i) {
    blocks.system.reset();
    const std::int64_t before = heap::live_bytes();
    const auto start = std::chrono::steady_clock::now();
    const OwnerScope scope(MemoryOwner::blocks);
    if (problem) blocks.system = assemble(method, problem);
    blocks.assembly_samples_s.push_back(seconds_since(start));
    blocks.heap_bytes = heap::live_bytes() - before;
  }
  return blocks;
}

std::optional<std::int64_t> if_probed(std::int64_t bytes) {
  return heap::is_active() ? std::optional(bytes) : std::nullopt;
}

Json to_json(const TimedRun& run) {
  return {{"time_s", run.time_s},
          {"stages", run.stages},
          {"status", name_of(run.end.status)},
          {"message", run.end.reason},
          {"runs_s", run.runs_s},
          {"program_s", run.program_s},
          {"processor_s", run.processor_s},
          {"program_solve_s", run.program_solve_s}};
}

TimedRun timed_run_of(const Json& json) {
  return {json.at("time_s").get<double>(),
          json.at("stages").get<std::map<std::string, double>>(),
          {status_of(json.at("status").get<std::string>()).value_or(Status::crashed),
           json.at("message").get<std::string>()},
          json.at("runs_s").get<double>(),
          json.at("program_s").get<double>(),
          json.at("processor_s").get<double>(),
          json.at("program_solve_s").get<double>()};
}

bool ended_alike(const TimedRun& run, const char* which, Record& record) {
  if (run.end.status == record.claimed_status) return true;
  record.conclude({run.end.status, fmt::format("in a {} run: {}", which, run.end.reason)});
  record.samples_s.clear();
  record.stage_samples.clear();
  record.program_samples_s.clear();
  record.processor_samples_s.clear();
  record.program_solve_samples_s.clear();
  for (const char* name : {"peak_heap_bytes", "peak_rss_bytes", "memory_by_owner",
                           "memory_counts_differ", "heap_allocations", "heap_allocated_bytes"})
    field_named(name).clear(record);
  return false;
}

void add_run(const TimedRun& run, Record& record) {
  if (run.runs_s > 0) record.runs_s = run.runs_s;
  if (!ended_alike(run, "timed", record)) return;
  record.samples_s.push_back(run.time_s);
  record.stage_samples.push_back(run.stages);
  if (run.program_s > 0) {
    record.program_samples_s.push_back(run.program_s);
    record.processor_samples_s.push_back(run.processor_s);
    record.program_solve_samples_s.push_back(run.program_solve_s);
  }
}

void note(const Solution& solution, Record& record) {
  take_over(solution, record);
  record.claimed_status = solution.status;
  if (const std::size_t bytes = matrix_bytes(solution); bytes > 0)
    record.storage_bytes = static_cast<std::int64_t>(bytes);
  if (solution.factor_flops) record.factor_flops = std::llround(*solution.factor_flops);
  if (const auto& times = solution.iteration_times) {
    record.iteration_matrix_s = times->matrix_s;
    record.iteration_smoother_s = times->smoother_s;
    record.iteration_coarse_s = times->coarse_s;
  }
}

// At the start, middle or end of a contact edge, before it deforms.
double gap_mm_at(const Problem& problem, int row, int node) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const Eigen::Vector2d &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  return problem.offset_at(a + node * (b - a) / 2, row)
      .along(problem.frame_at(row, node, 2).normal)
      .x();
}

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

std::vector<std::string> remarks_on_what_is_idle(const Problem& problem, const Verification& v) {
  std::vector<std::string> remarks;
  const MeshSizes sizes = mesh_sizes(problem.mesh);
  if (sizes.contact_edges + sizes.force_edges == 0) {
    remarks.emplace_back("the whole boundary is prescribed");
  } else if (sizes.contact_edges == 0) {
    remarks.emplace_back("there is no contact boundary");
  } else if (const int points = v.n_open.value_or(0);
             points > 0 && v.n_stick.value_or(0) + v.n_slip.value_or(0) == 0) {
    remarks.push_back(fmt::format("nothing touches the {}: all {} contact points are open{}",
                                  obstacle_of(problem), points, words_of_least_gap(problem)));
  }
  if (!problem.free.motions.empty())
    remarks.push_back(words_of_open_motions(rigid_contact(problem)));
  return remarks;
}

static std::string remark_on_dissipation(const Record& record) {
  constexpr double seen = 0.02;
  constexpr double min_share = 1e-3;  // of the path's largest strain energy: less is no loss
  double own = 0, halved = 0, energy = 0;
  const auto add_up = [&](const std::vector<StepResult>& steps, double& sum) {
    for (const StepResult& step : steps) {
      sum += step.dissipation_Nmm.value();
      energy = std::max(energy, step.strain_energy_Nmm.value());
    }
  };
  add_up(record.steps, own);
  add_up(record.steps_in_halves, halved);
  constexpr double of_rounding = 1e-9;
  for (double* sum : {&own, &halved})
    if (std::abs(*sum) < of_rounding * energy) *sum = 0;
  if (!(std::abs(own - halved) > seen * std::max({own, halved, min_share * energy}))) return "";
  return fmt::format(
      "with every load step in two halves friction dissipates {:.3g} N mm, not {:.3g}", halved,
      own);
}

std::vector<std::string> remarks_on_half_steps(const Record& record) {
  const bool all_ok = std::ranges::all_of(record.steps_in_halves, [](const StepResult& step) {
    return step.claimed_status == Status::ok;
  });
  if (record.steps_in_halves.size() != record.steps.size() || !all_ok)
    return {"with every load step in two halves there is no answer to compare with"};
  std::vector<std::string> remarks = {remark_on_dissipation(record)};
  const std::vector<StepChange> changes = changes_in_halves(record);
  const auto differs = std::ranges::count_if(changes, &StepChange::is_seen);
  if (differs == 0) return remarks;
  const auto worst = std::ranges::max_element(changes, {}, [](const StepChange& change) {
    return std::pair(change.points, change.of_force);
  });
  const auto& [points, of_force, F, F_halved] = *worst;
  const std::size_t k = worst - changes.begin();
  const StepResult &step = record.steps[k], &halved = record.steps_in_halves[k];
  remarks.push_back(
      fmt::format("with every load step in two halves {} of {} steps end otherwise, step {} most: "
                  "{} points stick and {} slip, not {} and {}; F = ({:.5g}, {:.5g}) N, not "
                  "({:.5g}, {:.5g})",
                  differs, changes.size(), k + 1, *halved.n_stick, *halved.n_slip, *step.n_stick,
                  *step.n_slip, F_halved.x(), F_halved.y(), F.x(), F.y()));
  return remarks;
}

std::string remark_on_polygons(const Method& method, const Record& record) {
  if (record.polygons.empty()) return "";
  // P3's and P4's error is to stresses that follow the curves: η is not of their chords.
  const bool is_of_chords = !method.in_displacements() || method.degree == 1;
  return fmt::format("curves that are solved as polygons: {}{}", record.polygons,
                     !record.error_discretisation || !record.error_geometry ? ""
                     : is_of_chords
                         ? fmt::format("; its total error contains η = {:.2g} % for them",
                                       100 * *record.error_geometry)
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

void note(const TotalError& total, const ConstitutiveError& last, const std::string& by,
          Record& record) {
  record.error_discretisation = total.relative();
  record.no_discretisation_error = total.flaw();
  if (total.relative()) record.discretisation_by = by;
  if (total.geometry() > 0) record.error_geometry = total.geometry();
  if (total.relative(total.steps() - 1) && is_verified(record))
    record.error_mean = last.relative_of_mean + record.error_stress.value_or(0) / 2;
  if (last.guaranteed) {
    record.lower_bound_Nmm = last.lower_bound_Nmm;
    record.upper_bound_Nmm = last.upper_bound_Nmm;
  }
}

void note(const ContactIntervals& intervals, Record& record) {
  record.intervals = intervals.guaranteed ? "guaranteed" : "estimated";
  note(intervals.normal_resultant_N, record.normal_resultant_low_N, record.normal_resultant_high_N);
  note(intervals.tangential_resultant_N, record.tangential_resultant_low_N,
       record.tangential_resultant_high_N);
  record.largest_pressure_MPa = intervals.largest_pressure_MPa;
  record.largest_pressure_is = name_of(intervals.peak);
  note(intervals.largest_pressure_within_MPa, record.largest_pressure_low_MPa,
       record.largest_pressure_high_MPa);
  record.contact_ends = Json::array();
  for (const ContactEnd& end : intervals.ends)
    record.contact_ends.push_back({{"face", end.face},
                                   {"from", name_of(end.before)},
                                   {"to", name_of(end.after)},
                                   {"x_mm", end.at_mm.x()},
                                   {"y_mm", end.at_mm.y()},
                                   {"low_mm", end.along_face_mm.low},
                                   {"high_mm", end.along_face_mm.high}});
}

void note(const MemorySplit& memory, Record& record) {
  take_over(memory, record);
  record.memory_by_owner = by_owner(memory);
  record.memory_counts_differ = counts_differ(memory);
}

}  // namespace airybench
