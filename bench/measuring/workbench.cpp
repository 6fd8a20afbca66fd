#include "bench/measuring/workbench.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "bench/cases/blank_record.hpp"
#include "bench/heap/heap_probe.hpp"
#include "bench/judging/displacement_recovery.hpp"
#include "bench/measuring/field_files.hpp"
#include "bench/measuring/instruction_counter.hpp"
#include "bench/measuring/memory_watch.hpp"
#include "bench/measuring/record_notes.hpp"
#include "bench/measuring/rss_probe.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

constexpr double tightest = 1e-15;  // tolerance of an iteration

std::optional<std::int64_t> if_probed(std::int64_t bytes) {
  return heap::is_active() ? std::optional(bytes) : std::nullopt;
}

// Whose displacements the discretisation error of the method's record is made with.
std::optional<Workbench::Bound> bound_for(const Method& method, const Options& options) {
  if (options.study == Study::error || method.in_displacements) return Workbench::Bound::p2;
  if (!options.adapt.empty() || options.mean_fields || options.study == Study::adapted)
    return Workbench::Bound::recovery;
  return {};
}

const char* name_of(Workbench::Bound bound) {
  return bound == Workbench::Bound::p2 ? "P2" : "recovery";
}

AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions) {
  AssembledBlocks blocks;
  for (int i = 0; i < repetitions; ++i) {
    blocks.system.reset();
    heap::reset_peak();
    const std::int64_t before = heap::live_bytes();
    const auto start = std::chrono::steady_clock::now();
    const OwnerScope scope(MemoryOwner::blocks);
    blocks.system.reset(new DualSystem(assemble(problem, which)));  // in place: no copy
    blocks.samples_s.push_back(seconds_since(start));
    blocks.heap_bytes = if_probed(heap::live_bytes() - before);
    blocks.peak_heap_bytes = if_probed(heap::peak_bytes() - before);
  }
  return blocks;
}

}  // namespace

Workbench::Workbench(std::shared_ptr<const Problem> problem, const Options& options,
                     LeftOut left_out)
    : problem_(std::move(problem)),
      options_(options),
      left_out_(std::move(left_out)),
      no_reference_(left_out_.reference) {}

void Workbench::prepare(const Method& method) {
  try {
    blocks(method.blocks);
  } catch (const std::exception&) {  // the examination will say it
    return;
  }
  reference();
  if (const auto bound = bound_for(method, options_)) discretisation(*bound);
}

const AssembledBlocks& Workbench::blocks(Blocks which) {
  if (const auto broken = left_out_.blocks.find(which); broken != left_out_.blocks.end())
    throw std::runtime_error(broken->second);
  auto found = blocks_.find(which);
  if (found == blocks_.end()) {
    const ActivityScope scope(board_, Activity::assembly);
    found =
        blocks_.emplace(which, assemble_and_measure(problem_, which, options_.repetitions)).first;
  }
  return found->second;
}

double Workbench::reference_error_at_most() const { return options_.target_error / 10; }

const Reference* Workbench::reference() {
  if (!reference_ && no_reference_.empty()) {
    const ActivityScope scope(board_, Activity::reference);
    try {
      const DualSystem system = assemble(problem_, Blocks::contact_points);
      reference_ = compute_reference(system);
      Solution as_solution;
      as_solution.F_C = reference_->F_C;
      as_solution.stress = reference_->stress;
      const double residual = verify(system, as_solution, nullptr).equilibrium_residual;
      const double at_most = reference_error_at_most();
      if (!(residual <= at_most && reference_->error_estimate <= at_most)) {
        no_reference_ = fmt::format(
            "no reference: by its own estimate its error is {:.1e}, its equilibrium residual "
            "{:.1e}",
            reference_->error_estimate, residual);
        reference_.reset();
      }
    } catch (const Breakdown& breakdown) {
      no_reference_ = breakdown.what();
    } catch (const std::bad_alloc&) {
      no_reference_ = "no reference: out of memory";
    }
  }
  return reference_ ? &*reference_ : nullptr;
}

const Workbench::Discretisation* Workbench::discretisation(Bound bound) {
  const auto [found, is_new] = discretisation_.try_emplace(bound);
  if (is_new && reference() != nullptr && left_out_.discretisation.empty())
    found->second = compute_discretisation(bound);
  return found->second ? &*found->second : nullptr;
}

std::optional<Workbench::Discretisation> Workbench::compute_discretisation(Bound bound) {
  const ActivityScope scope(board_, Activity::discretisation);
  const DualSystem system = assemble(problem_, Blocks::contact_points);
  const char* method = bound == Bound::p2 ? "P2" : options_.adapt_by.c_str();
  const Solution own = run(select_methods(method).front(), system, {});
  if (own.status != Status::ok) return {};
  Discretisation result;
  if (bound == Bound::p2) {
    result.u = own.displacement;
    result.error = constitutive_error(system, reference_->stress, reference_->F_C, result.u);
    return result;
  }
  result.u = recovered_displacement(system, own.stress, own.F_C, own.edge_moments);
  result.error = constitutive_error(system, own.stress, own.F_C, result.u);
  if (result.error.flaw.empty())
    result.intervals = contact_intervals(system, own.stress, own.F_C, result.u, result.error);
  return result;
}

Workbench::Run Workbench::solve(const Choice& choice, const AssembledBlocks& blocks,
                                Activity what) {
  const bool histories = what == Activity::detail_run;
  const ActivityScope scope(board_, what);
  RunControl control;
  control.deadline = Deadline::after(options_.timeout_s);
  control.histories = histories;
  control.threads = options_.threads;
  control.stop = options_.stop;
  control.contact = options_.contact;
  control.target_error = options_.target_error;
  control.condition = histories && asks_for_condition(options_.study);
  control.tolerance = choice.tolerance;
  control.contact_acceptable = std::max(control.contact_tolerance, options_.target_error / 1000);
  const bool rss_is_reset = rss::reset_peak();
  const std::int64_t of_blocks = blocks.heap_bytes.value_or(0);
  const MemoryWatch watch(of_blocks);
  const std::int64_t limit_base = heap::live_bytes() - of_blocks;
  std::optional<InstructionCounter> counter;
  if (what == Activity::memory_run) counter.emplace();
  const auto start = std::chrono::steady_clock::now();
  Run result;
  bool refused = false;
  try {
    std::optional<heap::Limit> limit;
    if (options_.memory_limit_bytes) limit.emplace(limit_base + *options_.memory_limit_bytes);
    result.solution = run(choice.solve, *blocks.system, control);
    refused = limit && limit->exceeded();
  } catch (const std::bad_alloc&) {  // so little that not even a message could be written
    refused = true;
  }
  result.time_s = seconds_since(start);
  if (counter) result.instructions = counter->count();
  if (heap::is_active()) {
    result.peak_heap_bytes = watch.peak_bytes();
    result.memory = watch.split(result.solution, blocks.system->bytes());
  }
  if (rss_is_reset) result.peak_rss_bytes = rss::peak_bytes();
  if (refused) {
    result.solution = Solution();
    result.solution.status = Status::out_of_memory;
    result.solution.message = "the memory limit was reached";
  }
  return result;
}

Workbench::Choice Workbench::choose(const Method& method, const AssembledBlocks& blocks,
                                    Record& record) {
  Choice choice{method.solve, 0};
  if (method.is_tightened()) {
    choice.tolerance = options_.stop == Stop::paper
                           ? method.paper_tolerance
                           : std::max(tightest, method.first_tolerance * options_.target_error);
  }
  if (!method.tune) return choice;
  Tuning tuning;
  const auto tune = [&](const DualSystem& system, const RunControl& control) {
    tuning = method.tune(system, control);
    Solution none;
    none.status = Status::skipped;
    return none;
  };
  const Run tuned = solve({tune, choice.tolerance}, blocks, Activity::tuning);
  record.tuning_s = tuned.time_s;
  note(tuning.grid, record);
  if (tuning.solve != nullptr) {
    choice.solve = tuning.solve;
  } else {  // every run says what became of it
    choice.solve = [status = tuned.solution.status, message = tuned.solution.message](
                       const DualSystem&, const RunControl&) {
      Solution solution;
      solution.status = status;
      solution.message = "while choosing parameters: " + message;
      return solution;
    };
  }
  return choice;
}

// What the method said with a tolerance, and what was true: nobody has told it.
void Workbench::note_attempt(const Choice& choice, const AssembledBlocks& blocks, Run& run,
                             Record& record) {
  Json attempt = {{"tolerance", choice.tolerance},
                  {"claimed_status", name_of(run.solution.status)}};
  if (run.solution.error_estimate) attempt["error_estimate"] = *run.solution.error_estimate;
  if (!run.solution.stress.empty() && reference() != nullptr) {
    verify_run(blocks, run);
    attempt["error"] = worst_measure(*run.verification).value;
  }
  record.attempts.push_back(std::move(attempt));
}

Workbench::Run Workbench::tighten(const Method& method, const AssembledBlocks& assembled,
                                  Choice& choice, Record& record) {
  constexpr int most_attempts = 6;
  std::optional<Run> finished;  // not accurate enough, with the tolerance before
  double finished_with = 0;
  for (int attempt = 1;; ++attempt) {
    malloc_trim(0);  // what earlier runs freed shall not count
    Run run = solve(choice, assembled, Activity::detail_run);
    const Solution& solution = run.solution;
    if (finished && !has_answer(solution.status)) {  // better than nothing
      record.tuning_s = *record.tuning_s - finished->time_s + run.time_s;
      choice.tolerance = finished_with;
      return std::move(*finished);
    }
    if (!method.is_tightened()) return run;
    note_attempt(choice, assembled, run, record);
    const double estimate = solution.error_estimate.value_or(0);
    if (options_.stop == Stop::paper || !has_answer(solution.status) ||
        solution.status == Status::ok || attempt == most_attempts || choice.tolerance <= tightest)
      return run;
    record.tuning_s = record.tuning_s.value_or(0) + run.time_s;
    finished_with = choice.tolerance;
    // Errors follow the tolerance about linearly; a factor of 3 to be sure.
    const double factor = options_.target_error / estimate / 3;
    choice.tolerance *= std::isfinite(factor) ? std::clamp(factor, 1e-3, 0.3) : 0.1;
    choice.tolerance = std::max(tightest, choice.tolerance);
    finished = std::move(run);
  }
}

void Workbench::verify_run(const AssembledBlocks& blocks, Run& run) {
  if (run.verification) return;
  const ActivityScope scope(board_, Activity::verification);
  run.verification = run.solution.displacement.cols() > 0
                         ? verify_displacement(*blocks.system, run.solution)
                         : verify(*blocks.system, run.solution, reference());
}

std::optional<Verification> Workbench::verify_as_other_solution(const AssembledBlocks& blocks,
                                                                const Run& run) {
  const Verification& v = *run.verification;
  // Only where the law is met with the reference's D and G, but by other forces.
  if (!v.friction_coupling || !(std::max(v.natural_map_residual.value_or(0),
                                         v.equilibrium_residual) <= options_.target_error))
    return {};
  try {
    const ActivityScope scope(board_, Activity::verification);
    const DualSystem system = assemble(problem_, Blocks::contact_points);
    const Reference other = compute_reference(system, run.solution.F_C);
    if (!(other.error_estimate <= reference_error_at_most())) return {};
    const Verification seen = verify(*blocks.system, run.solution, &other);
    return worst_measure(seen).value <= options_.target_error ? std::optional(seen) : std::nullopt;
  } catch (const Breakdown&) {
    return {};
  }
}

void Workbench::judge(const Method& method, const AssembledBlocks& blocks, const Run& run,
                      Record& record) {
  const Verification& v = *run.verification;
  note(v, record);
  if (record.status != Status::ok) return;
  const WorstMeasure worst = worst_measure(v);
  if (!(worst.value <= options_.target_error)) {
    if (const auto other = verify_as_other_solution(blocks, run)) {
      note(*other, record);
      record.other_solution = true;
      record.status_reason = fmt::format(
          "another solution than the reference's, {:.1e} of its stress away; errors are to this "
          "one",
          v.error_stress.value_or(0));
      return;
    }
    record.status = Status::inaccurate;
    record.status_reason = fmt::format("{} {:.2e} is above the target {:.0e}", worst.name,
                                       worst.value, options_.target_error);
  } else if (!v.error_stress && !method.in_displacements) {
    record.status = Status::inaccurate;
    record.status_reason = "its error is not known: " + no_reference_;
  } else if (v.unstressed) {
    record.status = Status::unstressed;
    record.status_reason = method.in_displacements
                               ? "its displacements have no stress: nothing touches or loads what "
                                 "is free of them"
                               : "the body has no stress: nothing touches or loads it";
  }
}

void Workbench::note_discretisation(const Method& method, const Solution& solution,
                                    const std::filesystem::path& fields, Record& record) {
  const std::optional<Bound> bound = bound_for(method, options_);
  const Discretisation* known = bound ? discretisation(*bound) : nullptr;
  if (known == nullptr) return;
  if (record.other_solution) {
    record.no_discretisation_error = "it is known for the reference's solution only";
  } else {
    note(known->error, name_of(*bound), record);
    if (known->intervals) note(*known->intervals, record);
  }
  if (fields.empty() || !known->error.flaw.empty()) return;
  write_error_field(fields.parent_path(), fields.filename(), known->error);
  if (options_.mean_fields)
    write_mean_field(fields.parent_path(), fields.filename(), *problem_,
                     mean_stress(*problem_, solution.stress, known->u));
}

Workbench::Examination Workbench::examine(const Method& method,
                                          const std::filesystem::path& fields) {
  Examination examination;
  Record& record = examination.record;
  record = blank_record(*problem_, method, options_);
  try {
    blocks(method.blocks);
  } catch (const std::exception& error) {
    record.status = Status::breakdown;
    record.status_reason = fmt::format("assembly: {}", error.what());
    return examination;
  }
  const AssembledBlocks& assembled = blocks(method.blocks);
  record.assembly_samples_s = assembled.samples_s;
  record.blocks_heap_bytes = assembled.heap_bytes;
  record.assembly_peak_heap_bytes = assembled.peak_heap_bytes;

  Choice& choice = examination.choice;
  choice = choose(method, assembled, record);
  Run run = tighten(method, assembled, choice, record);
  Solution& solution = run.solution;
  note(solution, record);
  if (choice.tolerance > 0) record.tolerance = choice.tolerance;
  if (options_.histories) note(solution.histories, record);
  if (solution.status == Status::timeout) {
    record.done_fraction = solution.done_fraction;
    record.error_so_far = solution.error_so_far;
    if (solution.done_fraction) {  // the solve itself was at work: at least so much memory
      record.peak_heap_bytes = run.peak_heap_bytes;
      record.peak_rss_bytes = run.peak_rss_bytes;
    }
    if (solution.done_fraction.value_or(0) > 0)
      record.extrapolated_time_s = run.time_s / *solution.done_fraction;
  }
  if (!solution.stress.empty()) {
    verify_run(assembled, run);
    judge(method, assembled, run, record);
    if (!fields.empty())
      write_fields(fields.parent_path(), fields.filename(), *assembled.system, solution);
    note_discretisation(method, solution, fields, record);
  }
  const bool once = run.time_s > options_.long_case_s || options_.study == Study::stability;
  if (once && is_measured(record)) {
    record.measured_once = true;
    record.samples_s.push_back(run.time_s);
    record.stage_samples.push_back(by_name(solution.times));
    note_memory(run, record);
  }
  return examination;
}

void Workbench::note_memory(const Run& run, Record& record) {
  record.peak_heap_bytes = run.peak_heap_bytes;
  record.peak_rss_bytes = run.peak_rss_bytes;
  record.process_peak_heap_bytes = if_probed(heap::peak_ever_bytes());
  if (run.memory) note(*run.memory, record);
}

void Workbench::measure_memory(const Method& method, const Choice& choice, Record& record) {
  malloc_trim(0);
  const Run run = solve(choice, blocks(method.blocks), Activity::memory_run);
  note_memory(run, record);
  record.instructions = run.instructions;
}

TimedRun Workbench::measure_time(const Method& method, const Choice& choice) {
  const Run run = solve(choice, blocks(method.blocks), Activity::timed_run);
  TimedRun timed;
  timed.time_s = run.time_s;
  timed.stages = by_name(run.solution.times);
  timed.status = run.solution.status;
  timed.message = run.solution.message;
  return timed;
}

}  // namespace airybench
