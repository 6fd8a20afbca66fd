#include "bench/measure/workbench.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "bench/measure/heap_probe.hpp"
#include "bench/measure/step_fields.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

constexpr double tightest = 1e-15;  // tolerance of an iteration

}  // namespace

Workbench::Workbench(PosedProblem problem, const CaseSettings& common, const Limits& limits,
                     const LeftOut& left_out)
    : posed_(std::move(problem)),
      problem_(held<Problem>(posed_)),
      contact_problem_(held<contact::Problem>(posed_)),
      limits_(limits),
      judge_(posed_, common, left_out) {}

void Workbench::show_on(ActivityBoard* board) {
  board_ = board;
  judge_.show_on(board);
}

void Workbench::prepare(const Method& method) {
  try {
    blocks(method);
  } catch (const std::exception&) {  // examine() reports it
    return;
  }
  judge_.prepare(method);
}

const AssembledBlocks& Workbench::blocks(const Method& method) {
  const BlocksKey which = blocks_key(method);
  auto found = blocks_.find(which);
  if (found == blocks_.end()) {
    const ActivityScope scope(board_, Activity::assembly);
    found =
        blocks_.emplace(which, assemble_and_measure(problem_, method, limits_.repetitions)).first;
  }
  return found->second;
}

Workbench::Examination Workbench::examine(const Case& asked, const std::filesystem::path& fields) {
  const Method& method = asked.method;
  Examination examination;
  auto& [record, choice, program_log] = examination;
  record = blank_record(asked, limits_);
  try {
    take_over(blocks(method), record);
  } catch (const std::bad_alloc&) {
    record.conclude({Status::out_of_memory, "assembly: an allocation was refused"});
    return examination;
  } catch (const std::exception& error) {
    record.conclude({Status::breakdown, fmt::format("assembly: {}", error.what())});
    return examination;
  }
  const AssembledBlocks& assembled = blocks(method);
  choice = choose(asked, assembled, record);
  Run run = tighten(assembled, choice, record);
  Solution& solution = run.solution;
  note_run(run, choice, record);
  if (solution.program) program_log = std::move(solution.program->log);
  Verdict verdict = verdict_of(run, record);
  if (judge_.is_answered(solution)) {
    verify_run(assembled, run);
    verdict = judge_.judge(asked, run.judged, solution, std::move(verdict), record);
  }
  record.conclude(verdict);
  if (!fields.empty() && problem_) write_fields(method, choice, assembled, run, record, fields);
  // The detail run of a path judges between its steps, which takes memory.
  const bool once =
      record.load_steps == 1 && (run.time_s > limits_.long_case_s || asked.settings.timed_once);
  if (once && is_measured(record)) {
    record.measured_once = true;
    add_run(timed(run), record);
    note_memory(run, record);
  }
  return examination;
}

void Workbench::measure_memory(const Method& method, const Choice& choice, Record& record) {
  malloc_trim(0);
  const Run run = solve(choice, blocks(method), Activity::memory_run);
  if (!ended_alike(timed(run), "memory", record)) return;
  note_memory(run, record);
}

TimedRun Workbench::measure_time(const Method& method, const Choice& choice) {
  return timed(solve(choice, blocks(method), Activity::timed_run));
}

Workbench::Choice Workbench::choose(const Case& asked, const AssembledBlocks& blocks,
                                    Record& record) {
  const Method& method = asked.method;
  Choice choice{method.solve, method.solve_contact, asked.settings};
  CaseSettings& settings = choice.settings;
  settings.tightened = settings.tightened && method.is_tightened();
  if (settings.tightened)
    settings.tolerance = settings.stop == Stop::paper
                             ? method.paper_tolerance
                             : std::max(tightest, method.first_tolerance * settings.target_error);
  if (!method.tune) return choice;
  Tuning tuning;
  const auto tune = [&](const ContactSystem& system, const RunControl& control) {
    tuning = method.tune(system, control);
    Solution none;
    none.status = Status::skipped;
    return none;
  };
  const Run tuned = solve({tune, {}, settings}, blocks, Activity::tuning);
  record.tuning_s = tuned.time_s;
  record.tuning_cut =
      tuned.solution.status == Status::timeout ||
      std::ranges::any_of(tuning.grid, [](const GridPoint& p) { return p.outcome == "not tried"; });
  if (tuning.solve != nullptr) {
    choice.solve = tuning.solve;
  } else {  // every run reports the failure
    choice.solve = [status = tuned.solution.status, message = tuned.solution.message](
                       const ContactSystem&, const RunControl&) {
      Solution solution;
      solution.status = status;
      solution.message = "while choosing parameters: " + message;
      return solution;
    };
  }
  return choice;
}

// Records the claimed and the true error of a tolerance; the method never sees the true one.
void Workbench::note_attempt(const Choice& choice, const AssembledBlocks& blocks, Run& run,
                             Record& record) {
  Json attempt = {{"tolerance", *choice.settings.tolerance},
                  {"claimed_status", name_of(run.solution.status)}};
  if (run.solution.error_estimate) attempt["error_estimate"] = *run.solution.error_estimate;
  if (judge_.is_answered(run.solution) && judge_.knows_errors(blocks)) {
    verify_run(blocks, run);
    attempt["error"] = worst_measure(run.judged[worst_step(run.judged)].seen()).value;
  }
  record.attempts.push_back(std::move(attempt));
}

Workbench::Run Workbench::tighten(const AssembledBlocks& assembled, Choice& choice,
                                  Record& record) {
  constexpr int max_attempts = 6;
  std::optional<Run> finished;  // the last answer, not accurate enough
  double finished_with = 0;
  const CaseSettings& asked = choice.settings;
  for (int attempt = 1;; ++attempt) {
    malloc_trim(0);  // memory that earlier runs freed must not count
    Run run = solve(choice, assembled, Activity::detail_run);
    const Solution& solution = run.solution;
    if (finished && !has_answer(solution.status)) {  // the earlier answer is better than none
      record.tuning_s = *record.tuning_s - finished->time_s + run.time_s;
      choice.settings.tolerance = finished_with;
      return std::move(*finished);
    }
    if (!asked.tightened) return run;
    note_attempt(choice, assembled, run, record);
    const double estimate = solution.error_estimate.value_or(0);
    double tolerance = *asked.tolerance;
    if (asked.stop == Stop::paper || !has_answer(solution.status) ||
        solution.status == Status::ok || attempt == max_attempts || tolerance <= tightest)
      return run;
    const double searched_s = record.tuning_s.value_or(0) + run.time_s;
    if (limits_.tuning_budget_s && searched_s >= *limits_.tuning_budget_s) {
      record.tuning_cut = true;
      return run;
    }
    record.tuning_s = searched_s;
    finished_with = tolerance;
    // Errors are about proportional to the tolerance; 3 is a safety factor.
    const double factor = asked.target_error / estimate / 3;
    tolerance *= std::isfinite(factor) ? std::clamp(factor, 1e-3, 0.3) : 0.1;
    choice.settings.tolerance = std::max(tightest, tolerance);
    finished = std::move(run);
  }
}

RunControl Workbench::control_of(const CaseSettings& settings, Activity what) const {
  const bool in_detail = what == Activity::detail_run;
  RunControl control;
  control.deadline = Deadline::after(run_limit_s(what, limits_));
  control.histories = in_detail;
  control.condition = in_detail && settings.condition;
  control.threads = settings.threads;
  control.stop = settings.stop;
  control.target_error = settings.target_error;
  control.tolerance = settings.tolerance.value_or(0);
  control.max_iterations = settings.max_iterations;
  ContactOptions& contact = control.contact;
  contact.solver = settings.contact.value_or(contact.solver);
  contact.tolerance = settings.contact_tolerance.value_or(contact.tolerance);
  contact.acceptable = std::max(contact.tolerance, settings.target_error / 1000);
  contact.max_iterations = settings.max_contact_iterations.value_or(contact.max_iterations);
  return control;
}

Workbench::Run Workbench::solve(const Choice& choice, const AssembledBlocks& blocks,
                                Activity what) {
  const bool in_detail = what == Activity::detail_run;
  if (problem_ && blocks.system->problem != problem_) blocks.system->set_load_case(problem_);
  const ActivityScope scope(board_, what);
  const RunControl control = control_of(choice.settings, what);
  const bool rss_is_reset = rss::reset_peak();
  const std::int64_t of_blocks = blocks.heap_bytes;
  const MemoryWatch watch(of_blocks);
  const std::int64_t limit_base = heap::live_bytes() - of_blocks;
  Run result;
  VisitStep visit;
  if (in_detail)
    visit = [&](int, const ContactSystem& posed, const Solution& answer) {
      if (!answer.stress.empty())
        result.judged.push_back(judge_.judged(result.judged, posed, answer));
    };
  double watched_s = 0;
  const auto start = std::chrono::steady_clock::now();
  bool refused = false;
  try {
    std::optional<heap::Limit> limit;
    if (limits_.memory_limit_bytes) limit.emplace(limit_base + *limits_.memory_limit_bytes);
    result.solution = contact_problem_ ? run(choice.solve_contact, *contact_problem_, control)
                      : what == Activity::tuning
                          ? run(choice.solve, *blocks.system, control)
                          : solve_path(choice.solve, *blocks.system, control, visit, watched_s);
    refused = limit && limit->exceeded();
  } catch (const std::bad_alloc&) {  // not even a message could be allocated
    refused = true;
  }
  result.time_s = seconds_since(start) - watched_s;
  if (const auto& program = result.solution.program) {  // its memory is not in our heap
    result.time_s -= program->not_solve_s;
    if (program->peak_bytes > 0) result.peak_rss_bytes = program->peak_bytes;
    return result;
  }
  if (heap::is_active()) {
    result.peak_heap_bytes = watch.peak_bytes();
    result.memory = watch.split(result.solution, blocks.system ? blocks.system->bytes() : 0);
  }
  if (rss_is_reset) result.peak_rss_bytes = rss::peak_bytes();
  if (refused) {
    result.solution = Solution();
    result.solution.status = Status::out_of_memory;
    result.solution.message = "the memory limit was reached";
  }
  return result;
}

void Workbench::verify_run(const AssembledBlocks& blocks, Run& run) {
  if (run.judged.empty()) run.judged.push_back(judge_.judged(blocks, run.solution));
}

void Workbench::write_fields(const Method& method, const Choice& choice,
                             const AssembledBlocks& blocks, const Run& run, Record& record,
                             const std::filesystem::path& file) {
  remove_step_fields(file.parent_path(), file.filename());
  if (record.load_steps == 1) {
    if (judge_.is_answered(run.solution))
      judge_.write_fields_of(method, *blocks.system, run.solution, record, file);
    return;
  }
  if (run.judged.empty() || run.solution.status == Status::timeout) return;
  blocks.system->set_load_case(problem_);
  StepFields files(file.parent_path(), file.filename(), *problem_);
  const ActivityScope scope(board_, Activity::discretisation);
  double watched_s = 0;
  solve_path(
      choice.solve, *blocks.system, control_of(choice.settings, Activity::detail_run),
      [&](int step, const ContactSystem& posed, const Solution& answer) {
        const auto k = static_cast<std::size_t>(step);
        if (answer.stress.empty() || k >= run.judged.size()) return;
        record.steps[k].fields = files.write(step, own_fields(posed, answer), run.judged[k]);
        if (step + 1 == record.load_steps)
          judge_.write_fields_of(method, posed, answer, record, file);
      },
      watched_s);
}

// The method's own.
Verdict Workbench::verdict_of(const Run& run, const Record& record) {
  Verdict verdict = {run.solution.status, run.solution.message};
  if (record.tuning_cut && verdict.status != Status::ok)
    verdict.add("the search was cut: see tuning_cut");
  return verdict;
}

void Workbench::note_run(const Run& run, const Choice& choice, Record& record) {
  const Solution& solution = run.solution;
  note(solution, record);
  if (choice.settings.tightened && choice.settings.tolerance > 0)
    record.tolerance = choice.settings.tolerance;
  if (choice.settings.histories)
    for (const IterationHistory& history : solution.histories)
      record.histories[history.what] = history.residual;
  if (solution.done_fraction) {  // timeout in the solve itself: a lower bound
    record.peak_heap_bytes = run.peak_heap_bytes;
    record.peak_rss_bytes = run.peak_rss_bytes;
    if (*solution.done_fraction > 0)
      record.extrapolated_time_s = run.time_s / *solution.done_fraction;
  }
  if (record.load_steps > 1) record.steps = step_results(run.judged);
}

void Workbench::note_memory(const Run& run, Record& record) {
  record.peak_heap_bytes = run.peak_heap_bytes;
  record.peak_rss_bytes = run.peak_rss_bytes;
  record.process_peak_heap_bytes = if_probed(heap::peak_ever_bytes());
  if (run.memory) note(*run.memory, record);
}

TimedRun Workbench::timed(const Run& run) {
  TimedRun result;
  result.time_s = run.time_s;
  result.end = {run.solution.status, run.solution.message};
  for (const Stage stage : all_stages)
    if (const auto& seconds = run.solution.times[stage])
      result.stages[std::string(name_of(stage))] = *seconds;
  if (const auto& program = run.solution.program) {
    result.program_s = program->wall_s;
    result.program_solve_s = program->solve_s;
    result.processor_s = program->processor_s;
  }
  return result;
}

}  // namespace airybench
