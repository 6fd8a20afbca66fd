#include "bench/run/isolated_scene.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <sstream>
#include <system_error>

#include "bench/measure/environment.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/measure/step_fields.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/json.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/seconds_since.hpp"
#include "support/sign_of_life.hpp"
#include "support/temporary_folder.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr int max_tries = 4;

struct Command {
  explicit Command(const std::string& line) { std::istringstream(line) >> verb >> k; }
  std::string verb;
  std::size_t k = 0;
};

double limit_s(const ActivityBoard& board, const Limits& limits) {
  return is_run(board.activity()) ? run_limit_s(board.activity(), limits) : phase_limit_s(limits);
}

void keep_log(const Case& c, const std::filesystem::path& out, const CaseResult& result) {
  if (!result.solution || !result.solution->program || result.solution->program->log.empty())
    return;
  make_folder(out / "programs");
  write_file_atomically(out / "programs" / (c.name().file() + ".txt"),
                        result.solution->program->log);
}

void serve_case(Channel& channel, const Case& c, const Limits& limits,
                const std::filesystem::path& out, Workbench& bench, const ActivityBoard& board) {
  set_threads(c.settings.threads);
  const heap::Backstop backstop(limits.memory_limit_bytes);
  const std::filesystem::path fields =
      c.settings.fields ? out / "fields" / c.name().file() : std::filesystem::path();
  Workbench::Choice choice;
  while (const auto line = channel.receive()) {
    if (Command(*line).verb != "examine") {
      TimedRun run = bench.measure_time(c.method, choice);
      run.runs_s = board.seconds_in_runs();
      channel.send(json_text(to_json(run)));
      continue;
    }
    CaseResult result;
    try {
      Workbench::Examination examination = bench.examine(c, fields);
      result = std::move(examination.result);
      choice = std::move(examination.choice);
      keep_log(c, out, result);
    } catch (const FileError& error) {  // from a field or a log
      result = {.verdict = {Status::machine_fault, error.what()}};
    }
    if (is_measured(c, result) && !result.only_run) bench.measure_memory(c.method, choice, result);
    result.runs_s = board.seconds_in_runs();
    channel.send(json_text(to_json(to_record(c, limits, result))));
  }
}

struct CaseProcess {
  ActivityBoard board;
  std::unique_ptr<ChildProcess> process;
};

// Of external programs: one may have killed its guardian and its case's process.
void end_orphans(const std::map<std::size_t, CaseProcess>& processes) {
  std::vector<pid_t> children;
  for (const auto& [k, own] : processes)
    if (own.process != nullptr) children.push_back(own.process->pid());
  end_others_than(children);
}

Record record_of_end(const Case& c, const Limits& limits, const TimedRun& last) {
  return to_record(c, limits, {.verdict = last.end, .runs_s = last.runs_s});
}

void serve_scene(Channel& channel, const std::vector<const Case*>& cases, const Limits& limits,
                 const std::filesystem::path& out, ActivityBoard& board, const LeftOut& left_out) {
  tell_refused_memory_at_exit();
  adopt_orphans();
  set_threads(1);  // OpenMP's threads would not survive the forks
  Workbench bench(cases.front()->posed.problem, cases.front()->settings, limits, left_out);
  bench.show_on(&board);
  std::map<std::size_t, CaseProcess> processes;
  while (const auto line = channel.receive()) {
    const Command command(*line);
    const Case& c = *cases[command.k];
    if (command.verb == "prepare" || command.verb == "end") {
      if (command.verb == "prepare")
        bench.prepare(c.method);
      else
        processes.erase(command.k);
      channel.send("{}");
      continue;
    }
    const bool examines = command.verb == "examine";
    CaseProcess& own = processes[command.k];
    std::optional<std::string> answer;
    TimedRun last;
    const auto ask = [&] {
      if (own.process == nullptr)
        own.process = std::make_unique<ChildProcess>([&](Channel& to_scene) {
          bench.show_on(&own.board);
          const ObservedStages observed(&own.board);
          serve_case(to_scene, c, limits, out, bench, own.board);
        });
      own.board.beat();
      answer = own.process->ask(*line, [&](double suspended_s) {
        board.beat();
        own.board.skip(suspended_s);
        return is_overdue(own.board, limits);
      });
      if (answer) return !own.process->was_suspended();
      last = obituary_of(own.process->end(), own.board, limits);
      end_orphans(processes);
      return true;
    };
    try {
      for (int attempts = 1; !ask(); ++attempts) {
        answer.reset();
        last.end = {Status::machine_fault,
                    fmt::format("its process was suspended in all of {} attempts", attempts)};
        if (attempts == max_tries) break;
        if (examines) own.process.reset();
      }
    } catch (const std::system_error& error) {  // no process could be started
      last.end = {Status::machine_fault, error.what()};
    }
    if (!answer)
      answer = json_text(examines ? to_json(record_of_end(c, limits, last)) : to_json(last));
    channel.send(*answer);
  }
}

bool is_unheard(const ChildEnd& end) {
  return end.channel_error != 0 || end.exit_code == no_channel_exit_code;
}

Verdict why_no_answer(const ChildEnd& end) {
  if (end.stopped)
    return {Status::machine_fault, "the process of its scene was stopped by somebody, and ended"};
  if (end.timed_out)
    return {Status::machine_fault, "the process of its scene did not answer, and was ended"};
  if (end.exit_code == no_memory_exit_code)
    return {Status::machine_fault, "the process of its scene ended for lack of memory"};
  if (is_unheard(end)) return {Status::machine_fault, "the channel to its scene's process failed"};
  if (end.signal == SIGKILL || end.used_up_processor_time)
    return {Status::machine_fault,
            "the process of its scene was killed by " + signal_name(end.signal)};
  return {Status::crashed, "the process of its scene ended"};
}

}  // namespace

bool is_overdue(const ActivityBoard& board, const Limits& limits) {
  const double seconds = board.activity() == Activity::none ? board.silent_s() : board.seconds();
  return seconds > 1.1 * limit_s(board, limits) + 2;
}

void tell_refused_memory_at_exit() {
  std::atexit([] {
    if (heap::was_refused()) _exit(no_memory_exit_code);
  });
}

TimedRun obituary_of(const ChildEnd& end, const ActivityBoard& board, const Limits& limits) {
  TimedRun run;
  run.time_s = board.seconds();
  run.runs_s = board.seconds_in_runs();
  const std::string place =
      end.timed_out && board.activity() == Activity::none
          ? "between its runs"
          : fmt::format("in {} after {}", board.where(), show_seconds(run.time_s));
  const auto ended = [&](Status status, const std::string& how) {
    run.end = {status, fmt::format("its process was ended {}{}", place, how)};
    return run;
  };
  if (end.stopped) {
    run.end = {Status::machine_fault,
               fmt::format("its process was stopped by somebody {}, and ended", place)};
    return run;
  }
  if (is_unheard(end)) return ended(Status::machine_fault, ": the channel to it failed");
  if (end.timed_out)
    return ended(Status::timeout, fmt::format(": the limit is {} s", limit_s(board, limits)));
  if (end.exit_code == heap::backstop_exit_code)
    return ended(Status::out_of_memory, ": it passed the memory limit");
  if (end.exit_code == no_memory_exit_code)
    return ended(is_run(board.activity()) || board.activity() == Activity::assembly
                     ? Status::out_of_memory
                     : Status::machine_fault,
                 ": there was no memory");
  if (end.signal == 0) {
    run.end.reason = fmt::format("its process ended {} with exit code {}", place, end.exit_code);
    return run;
  }
  const std::string by = " by " + signal_name(end.signal);
  if ((end.signal == SIGKILL || end.signal == SIGXCPU) && end.used_up_processor_time)
    return ended(Status::machine_fault, by + ": the limit on processor time (ulimit -t)");
  if (end.signal != SIGKILL || end.lingered) return ended(Status::crashed, by);
  if (end.oom_killed == false)
    return ended(Status::machine_fault, by + ", not of the kernel for lack of memory");
  return ended(Status::out_of_memory,
               by + (end.oom_killed ? " of the kernel for lack of memory"
                                    : ", as the kernel does when memory runs out"));
}

bool IsolatedScene::is_silent() const {
  constexpr double max_silent_s = 20;
  return board_.activity() == Activity::none && board_.silent_s() > max_silent_s;
}

std::string IsolatedScene::sign_of(const std::string& verb, std::size_t k, double since_s) const {
  static const std::map<std::string, std::string> doing = {{"prepare", "assembly and reference"},
                                                           {"examine", "solve and check"},
                                                           {"time", "timed run"},
                                                           {"end", "its end"}};
  return fmt::format("... {}: {}, for {}", cases_[k]->name().text(), doing.at(verb),
                     show_duration(since_s));
}

std::optional<std::string> IsolatedScene::ask(const std::string& verb, std::size_t k) {
  if (process_ == nullptr) return {};
  board_.beat();
  const auto start = std::chrono::steady_clock::now();
  return process_->ask(fmt::format("{} {}", verb, k), [&](double suspended_s) {
    board_.skip(suspended_s);
    sign_of_life([&] { return sign_of(verb, k, seconds_since(start)); });
    return is_interrupted() || is_overdue(board_, limits_) || is_silent();
  });
}

// Prepares all cases first: a scene's process that breaks ends its cases' processes.
void IsolatedScene::prepare_all() {
  if (prepared_ && process_ != nullptr) return;
  const auto start = std::chrono::steady_clock::now();
  for (int attempt = 1;; ++attempt) {
    bool was_suspended = false;
    const std::size_t broken = broken_assemblies_.size();
    for (std::size_t k = 0; k < cases_.size(); ++k)
      if (why_skipped(cases_[k]->posed.problem, cases_[k]->method).empty()) {
        prepare(k);
        was_suspended |= process_ != nullptr && process_->was_suspended();
      }
    // Another process for the others, if the last one's assembly has ended this.
    const bool is_lost = process_ == nullptr && broken_assemblies_.size() > broken;
    if (!is_lost && (!was_suspended || attempt == max_tries)) break;
    process_.reset();  // it has timed the assembly
  }
  prepared_ = true;
  preparation_s_ += seconds_since(start);
}

void IsolatedScene::prepare(std::size_t k) {
  const BlocksKey blocks = blocks_key(cases_[k]->method);
  // Assembly, reference and discretisation may each break.
  for (int attempt = 0; attempt < max_tries && !broken_assemblies_.contains(blocks); ++attempt) {
    if (process_ == nullptr) {
      examined_.clear();
      try {
        process_ = std::make_unique<ChildProcess>([this](Channel& channel) {
          serve_scene(channel, cases_, limits_, out_, board_, left_out_);
        });
      } catch (const std::system_error& error) {
        why_no_process_ = {Status::machine_fault, error.what()};
        return;
      }
    }
    if (ask("prepare", k)) break;
    throw_if_interrupted();
    const ChildEnd& end = process_->end();
    const bool is_from_outside =
        end.stopped || is_unheard(end) || (end.signal == SIGKILL && end.oom_killed == false);
    const TimedRun obituary = obituary_of(end, board_, limits_);
    switch (is_from_outside ? Activity::none : board_.activity()) {
      case Activity::assembly:
        broken_assemblies_[blocks] = obituary;
        break;
      case Activity::discretisation:
        left_out_.discretisation = obituary.end.reason;
        break;
      case Activity::reference:
        left_out_.reference = "no reference: " + obituary.end.reason;
        break;
      default:  // try again
        break;
    }
    board_.ends();
    process_.reset();
  }
}

Record IsolatedScene::examine(std::size_t k) {
  remove_fields(out_ / "fields", cases_[k]->name().file());  // of an earlier run
  if (Record blank = blank_record(*cases_[k], limits_); blank.status == Status::skipped)
    return blank;
  prepare_all();
  if (const auto broken = broken_assemblies_.find(blocks_key(cases_[k]->method));
      broken != broken_assemblies_.end())
    return record_of_end(*cases_[k], limits_, broken->second);
  examined_.insert(k);
  const std::optional<std::string> answer = ask("examine", k);
  throw_if_interrupted();
  try {
    if (answer) return record_of_text(*answer, "its record");
  } catch (const RecordError& wrong) {
    return record_of_defect(*cases_[k], limits_, wrong);
  }
  end_process();
  return to_record(*cases_[k], limits_, {.verdict = why_no_process_});
}

TimedRun IsolatedScene::measure_time(std::size_t k) {
  const bool is_there = examined_.contains(k);
  std::optional<std::string> answer;
  if (is_there) answer = ask("time", k);
  throw_if_interrupted();
  TimedRun run;
  try {
    if (answer) return timed_run_of(parse_json(*answer));
  } catch (const Json::exception& wrong) {
    run.end.reason = fmt::format("its times are no numbers: {}", without_prefix(wrong));
    return run;
  }
  if (is_there) end_process();
  run.end = why_no_process_;
  return run;
}

void IsolatedScene::end_process() {
  if (process_ != nullptr) why_no_process_ = why_no_answer(process_->end());
  process_.reset();
}

void IsolatedScene::end(std::size_t k) {
  if (process_ != nullptr && !ask("end", k)) end_process();
  if (!cases_[k]->method.program.empty()) remove_abandoned_folders();
}

Record record_of_defect(const Case& c, const Limits& limits, const RecordError& wrong) {
  return to_record(c, limits, {.verdict = {Status::crashed, wrong.what()}});
}

}  // namespace airybench
