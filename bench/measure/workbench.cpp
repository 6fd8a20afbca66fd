#include "bench/measure/workbench.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "bench/measure/heap_probe.hpp"
#include "bench/measure/step_fields.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

void drop_arrays(CaseResult& result) {
  Solution& solution = *result.solution;
  for (Eigen::VectorXd* values :
       {&solution.F_C, &solution.contact_displacement, &solution.free_motion_mm})
    values->resize(0);
  solution.unknowns = {};
  solution.stress = {};
  solution.solve_again = {};
  for (JudgedStep& step : result.steps) step.displacement = {};
}

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
    found = blocks_.emplace(which, assemble_and_measure(method)).first;
  }
  return found->second;
}

AssembledBlocks Workbench::assemble_and_measure(const Method& method) const {
  AssembledBlocks blocks;
  for (int i = 0; i < limits_.repetitions; ++i) {
    blocks.system.reset();
    const std::int64_t before = heap::live_bytes();
    const auto start = std::chrono::steady_clock::now();
    const OwnerScope scope(MemoryOwner::blocks);
    if (problem_) {
      blocks.system = assemble(method, problem_);
      blocks.first = blocks.system->problem;
    }
    blocks.assembly_samples_s.push_back(seconds_since(start));
    blocks.heap_bytes = heap::live_bytes() - before;
  }
  return blocks;
}

Workbench::Examination Workbench::examine(const Case& asked, const std::filesystem::path& fields) {
  const Method& method = asked.method;
  Examination examination;
  auto& [result, choice] = examination;
  try {
    result.assembly_samples_s = blocks(method).assembly_samples_s;
  } catch (const std::bad_alloc&) {
    result.verdict = {Status::out_of_memory, "assembly: an allocation was refused"};
    return examination;
  } catch (const std::exception& error) {
    result.verdict = {Status::breakdown, fmt::format("assembly: {}", error.what())};
    return examination;
  }
  const AssembledBlocks& assembled = blocks(method);
  choice = choose(asked, assembled, result.search);
  Run run = tighten(assembled, choice, result.search);
  if (choice.settings.tightened && choice.settings.tolerance > 0)
    result.search.tolerance = choice.settings.tolerance;
  if (judge_.is_answered(run.solution)) verify_run(assembled, run);
  const TimedRun only_run = timed(run);
  result.solution = std::move(run.solution);
  result.steps = std::move(run.judged);
  result.verdict = judge_.judge(asked, result);
  if (!fields.empty() && problem_) write_fields(asked, choice, assembled, result, fields);
  const std::optional<double> done = result.solution->done_fraction;
  // The detail run of a path judges between its steps, which takes memory.
  const bool is_path = problem_ && count_of_steps(*problem_) > 1;
  if (!is_path && (run.time_s > limits_.long_case_s || asked.settings.timed_once) &&
      is_measured(asked, result)) {
    result.only_run = only_run;
    result.memory = run.memory;
  } else if (done) {  // timeout in the solve itself: a lower bound
    result.memory = {run.memory.peak_heap_bytes, run.memory.peak_rss_bytes, {}, {}};
  }
  if (done && *done > 0) result.extrapolated_time_s = run.time_s / *done;
  drop_arrays(result);
  return examination;
}

void Workbench::measure_memory(const Method& method, const Choice& choice, CaseResult& result) {
  malloc_trim(0);
  const Run run = solve(choice, blocks(method), Activity::memory_run);
  const bool ended_alike = run.solution.status == result.solution->status;
  if (!ended_alike) result.verdict = ended_otherwise(timed(run), "memory");
  result.memory = ended_alike ? run.memory : Memory();
}

TimedRun Workbench::measure_time(const Method& method, const Choice& choice) {
  return timed(solve(choice, blocks(method), Activity::timed_run));
}

Workbench::Choice Workbench::choose(const Case& asked, const AssembledBlocks& blocks,
                                    Search& search) {
  const Method& method = asked.method;
  Choice choice{method.solve, method.solve_contact, asked.settings};
  CaseSettings& settings = choice.settings;
  settings.tightened = settings.tightened && method.is_tightened();
  if (settings.tightened) settings.tolerance = first_tolerance(method, settings);
  if (!method.tune) return choice;
  Tuning tuning;
  const auto tune = [&](const ContactSystem& system, const RunControl& control) {
    tuning = method.tune(system, control);
    Solution none;
    none.status = Status::skipped;
    return none;
  };
  const Run tuned = solve({tune, {}, settings}, blocks, Activity::tuning);
  search.tuning_s = tuned.time_s;
  search.tuning_cut =
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

// With the true error of a tolerance, which the method never sees.
Search::Attempt Workbench::attempt_of(const Choice& choice, const AssembledBlocks& blocks,
                                      Run& run) {
  Search::Attempt attempt = {
      *choice.settings.tolerance, run.solution.status, run.solution.error_estimate, {}};
  if (judge_.is_answered(run.solution) && judge_.knows_errors(blocks.system.get())) {
    verify_run(blocks, run);
    attempt.error = worst_measure(run.judged[worst_step(run.judged)].seen()).value;
  }
  return attempt;
}

Workbench::Run Workbench::tighten(const AssembledBlocks& assembled, Choice& choice,
                                  Search& search) {
  std::optional<Run> finished;  // the last answer, not accurate enough
  double finished_with = 0;
  const CaseSettings& asked = choice.settings;
  for (int attempt = 1;; ++attempt) {
    malloc_trim(0);  // memory that earlier runs freed must not count
    Run run = solve(choice, assembled, Activity::detail_run);
    const Solution& solution = run.solution;
    if (finished && !has_answer(solution.status)) {  // the earlier answer is better than none
      search.tuning_s = *search.tuning_s - finished->time_s + run.time_s;
      choice.settings.tolerance = finished_with;
      return std::move(*finished);
    }
    if (!asked.tightened) return run;
    search.attempts.push_back(attempt_of(choice, assembled, run));
    if (asked.stop == Stop::paper || !has_answer(solution.status) ||
        solution.status == Status::ok || attempt == max_tightenings ||
        *asked.tolerance <= tightest_tolerance)
      return run;
    const double searched_s = search.tuning_s.value_or(0) + run.time_s;
    if (limits_.tuning_budget_s && searched_s >= *limits_.tuning_budget_s) {
      search.tuning_cut = true;
      return run;
    }
    search.tuning_s = searched_s;
    finished_with = *asked.tolerance;
    choice.settings.tolerance = next_tolerance(finished_with, solution, asked);
    finished = std::move(run);
  }
}

RunControl Workbench::control_of(const CaseSettings& settings, Activity what) const {
  const bool in_detail = what == Activity::detail_run;
  RunControl control = airybench::control_of(settings, Deadline::after(run_limit_s(what, limits_)));
  control.histories = in_detail;
  control.condition = in_detail && settings.condition;
  return control;
}

Workbench::Run Workbench::solve(const Choice& choice, const AssembledBlocks& blocks,
                                Activity what) {
  const bool in_detail = what == Activity::detail_run;
  if (blocks.first && blocks.system->problem != blocks.first)
    blocks.system->set_load_case(blocks.first);
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
  Memory& memory = result.memory;
  if (heap::is_active()) memory.process_peak_heap_bytes = heap::peak_ever_bytes();
  if (const auto& program = result.solution.program) {  // its memory is not in our heap
    result.time_s -= program->not_solve_s;
    if (program->peak_bytes > 0) memory.peak_rss_bytes = program->peak_bytes;
    return result;
  }
  if (heap::is_active()) {
    memory.peak_heap_bytes = watch.peak_bytes();
    memory.split = watch.split(result.solution, blocks.system ? blocks.system->bytes() : 0);
  }
  if (rss_is_reset) memory.peak_rss_bytes = rss::peak_bytes();
  if (refused) {
    result.solution = Solution();
    result.solution.status = Status::out_of_memory;
    result.solution.message = "the memory limit was reached";
  }
  return result;
}

void Workbench::verify_run(const AssembledBlocks& blocks, Run& run) {
  if (run.judged.empty()) run.judged.push_back(judge_.judged(blocks.system.get(), run.solution));
}

void Workbench::write_fields(const Case& asked, const Choice& choice, const AssembledBlocks& blocks,
                             CaseResult& result, const std::filesystem::path& file) {
  const Solution& solution = *result.solution;
  const int count = count_of_steps(*problem_);
  remove_step_fields(file.parent_path(), file.filename());
  if (count == 1) {
    if (judge_.is_answered(solution))
      judge_.write_fields_of(asked.method, *blocks.system, solution, result.is_other_solution,
                             file);
    return;
  }
  if (result.steps.empty() || solution.status == Status::timeout) return;
  blocks.system->set_load_case(blocks.first);
  StepFields files(file.parent_path(), file.filename(), *problem_);
  const ActivityScope scope(board_, Activity::discretisation);
  double watched_s = 0;
  solve_path(
      choice.solve, *blocks.system, control_of(choice.settings, Activity::detail_run),
      [&](int step, const ContactSystem& posed, const Solution& answer) {
        const auto k = static_cast<std::size_t>(step);
        if (answer.stress.empty() || k >= result.steps.size()) return;
        result.steps[k].fields = files.write(step, own_fields(posed, answer), result.steps[k]);
        if (step + 1 == count)
          judge_.write_fields_of(asked.method, posed, answer, result.is_other_solution, file);
      },
      watched_s);
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
