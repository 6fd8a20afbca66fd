#include "bench/run/isolated_scene.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <system_error>
#include <tuple>

#include "bench/plan/blank_record.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/json.hpp"
#include "bench/run/scene_process.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

volatile std::sig_atomic_t interrupting_signal = 0;

void on_interrupt(int signal) {
  if (interrupting_signal != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupting_signal = signal;
}

// Of a scene's process.
std::pair<Status, std::string> why_no_answer(const ChildEnd& end) {
  if (end.stopped)
    return {Status::machine_fault, "the process of its scene was stopped by somebody, and ended"};
  if (end.given_up)
    return {Status::machine_fault, "the process of its scene did not answer, and was ended"};
  if (end.exit_code == no_memory_exit_code)
    return {Status::machine_fault, "the process of its scene ended for lack of memory"};
  return {Status::crashed, "the process of its scene ended"};
}

}  // namespace

Interrupted::Interrupted(int number)
    : std::runtime_error(fmt::format("ended by {}", signal_name(number))), signal(number) {}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error that we can tell
}

void throw_if_interrupted() {
  if (interrupting_signal != 0) throw Interrupted(interrupting_signal);
}

IsolatedScene::IsolatedScene(const std::vector<const Case*>& cases, const Options& options)
    : cases_(cases), options_(options) {}

// Its process does something that it shows on the board, or waits for a case's and beats.
bool IsolatedScene::overdue() const {
  constexpr double most_silent_s = 20;
  return interrupting_signal != 0 || is_overdue(board_, options_) ||
         (board_.activity() == Activity::none && board_.silent_s() > most_silent_s);
}

std::optional<std::string> IsolatedScene::ask(const std::string& line) {
  if (process_ == nullptr) return {};
  board_.beat();
  return process_->ask(line, [this] { return overdue(); });
}

// All before the first case: a scene's process that breaks takes its cases' processes along.
void IsolatedScene::prepare_all() {
  if (prepared_ && process_ != nullptr) return;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < cases_.size(); ++k)
    if (why_skipped(cases_[k]->posed.problem, cases_[k]->method).empty()) prepare(k);
  prepared_ = true;
  preparation_s_ += seconds_since(start);
}

void IsolatedScene::prepare(std::size_t k) {
  constexpr int most_attempts = 4;  // assembly, reference and discretisation error may each break
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    if (process_ == nullptr) {
      ++generation_;
      try {
        process_ = std::make_unique<ChildProcess>([this](Channel& channel) {
          serve_scene(channel, cases_, options_, board_, left_out_);
        });
      } catch (const std::system_error& error) {
        no_process_ = error.what();
        return;
      }
    }
    if (ask(fmt::format("prepare {}", k))) break;
    throw_if_interrupted();
    const std::string why = obituary_of(process_->end(), board_, options_).message;
    switch (board_.activity()) {
      case Activity::assembly:
        left_out_.blocks[cases_[k]->method.blocks] = why;
        break;
      case Activity::discretisation:
        left_out_.discretisation = why;
        break;
      case Activity::reference:
        left_out_.reference = "no reference: " + why;
        break;
      default:  // ended from outside: once more
        break;
    }
    board_.ends();
    process_.reset();
  }
}

Record IsolatedScene::examine(std::size_t k) {
  Record record = blank_record(*cases_[k], options_);
  if (record.status == Status::skipped) return record;
  prepare_all();
  examined_in_[k] = generation_;
  const std::optional<std::string> answer = ask(fmt::format("examine {}", k));
  throw_if_interrupted();
  if (answer) return record_of(parse_json(*answer), "the case's process");
  if (process_ == nullptr) {
    record.status = Status::machine_fault;
    record.status_reason = no_process_;
    return record;
  }
  std::tie(record.status, record.status_reason) = why_no_answer(process_->end());
  process_.reset();
  return record;
}

TimedRun IsolatedScene::measure_time(std::size_t k) {
  std::optional<std::string> answer;
  if (examined_in_[k] == generation_) answer = ask(fmt::format("time {}", k));
  throw_if_interrupted();
  if (answer) return timed_run_of(parse_json(*answer));
  TimedRun run;
  std::tie(run.status, run.message) =
      why_no_answer(process_ == nullptr ? ChildEnd() : process_->end());
  if (examined_in_[k] == generation_) process_.reset();
  return run;
}

void IsolatedScene::end(std::size_t k) {
  if (process_ != nullptr && !ask(fmt::format("end {}", k))) process_.reset();
}

}  // namespace airybench
