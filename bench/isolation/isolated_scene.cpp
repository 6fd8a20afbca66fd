#include "bench/isolation/isolated_scene.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <system_error>

#include "bench/cases/blank_record.hpp"
#include "bench/isolation/scene_process.hpp"
#include "bench/records/json.hpp"
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

bool IsolatedScene::overdue() const {
  return interrupting_signal != 0 || is_overdue(board_, options_);
}

// All before the first case: a scene's process that breaks takes its cases' processes along.
void IsolatedScene::prepare_all() {
  if (prepared_ && process_ != nullptr) return;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < cases_.size(); ++k) prepare(k);
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
    if (process_->ask(fmt::format("prepare {}", k), [this] { return overdue(); })) break;
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
  prepare_all();
  examined_in_[k] = generation_;
  std::optional<std::string> answer;
  if (process_ != nullptr)
    answer = process_->ask(fmt::format("examine {}", k), [] { return interrupting_signal != 0; });
  throw_if_interrupted();
  if (answer) return record_of(parse_json(*answer), "the case's process");
  Record record = blank_record(*cases_[k], options_);
  if (process_ == nullptr) {
    record.status = Status::machine_fault;
    record.status_reason = no_process_;
    return record;
  }
  if (process_->end().stopped) record.status = Status::machine_fault;
  record.status_reason = process_->end().stopped
                             ? "the process of its scene was stopped by somebody, and ended"
                             : "the process of its scene ended";
  process_.reset();
  return record;
}

TimedRun IsolatedScene::measure_time(std::size_t k) {
  std::optional<std::string> answer;
  if (process_ != nullptr && examined_in_[k] == generation_)
    answer = process_->ask(fmt::format("time {}", k), [] { return interrupting_signal != 0; });
  throw_if_interrupted();
  if (answer) return timed_run_of(parse_json(*answer));
  if (examined_in_[k] == generation_) process_.reset();
  TimedRun run;
  run.message = "the process of its scene ended";
  return run;
}

void IsolatedScene::end(std::size_t k) {
  if (process_ != nullptr) process_->ask(fmt::format("end {}", k));
}

}  // namespace airybench
