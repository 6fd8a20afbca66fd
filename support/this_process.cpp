#include "support/this_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <vector>

#include "support/errors.hpp"
#include "support/process.hpp"

namespace airybench {
namespace {

volatile std::sig_atomic_t interrupting_signal = 0;

void on_interrupt(int signal) {
  if (interrupting_signal == 0) {
    interrupting_signal = signal;
  } else if (signal != SIGHUP) {  // the caller's end may follow what ended it
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

bool output_was_closed = false;

const char* last_words = "";
int last_code = 0;

[[noreturn]] void end_for_lack_of_memory() {
  try {
    if (std::current_exception() != nullptr) throw;
  } catch (const std::bad_alloc&) {
    std::fputs(last_words, stderr);
    std::_Exit(last_code);
  } catch (...) {
  }
  std::abort();
}

}  // namespace

Interrupted::Interrupted(int number)
    : std::runtime_error("ended by " + signal_name(number)), signal(number) {}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

CtrlCInterrupts::CtrlCInterrupts() {
  sigaction(SIGINT, nullptr, &former_);
  if (former_.sa_handler == SIG_IGN) return;
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
}
CtrlCInterrupts::~CtrlCInterrupts() {
  sigaction(SIGINT, &former_, nullptr);
  interrupting_signal = 0;
}

void interrupt_with_caller() { prctl(PR_SET_PDEATHSIG, SIGHUP); }

bool is_interrupted() { return interrupting_signal != 0; }

void throw_if_interrupted() {
  if (is_interrupted()) throw Interrupted(interrupting_signal);
}

void open_standard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int descriptor : {0, 1, 2})
    if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
      if (descriptor == 1) output_was_closed = true;
      // open() returns the lowest free descriptor: this one.
      static_cast<void>(open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY));
    }
}

void require_standard_output() {
  if (output_was_closed)
    throw UsageError("standard output: is closed (allowed: an open one, or --out=FILE)");
}

std::string lack_of_stack_or_descriptors() {
  constexpr rlim_t min_stack = 1024 * 1024;
  constexpr int min_descriptors = 24;
  rlimit stack = {};
  if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < min_stack)
    return fmt::format("the stack is limited to {} KiB (ulimit -s; allowed: from {} KiB on)",
                       stack.rlim_cur / 1024, min_stack / 1024);
  std::vector<int> taken;
  for (int free = 0; free < min_descriptors; ++free)
    if (const int descriptor = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0); descriptor >= 0)
      taken.push_back(descriptor);
  for (const int descriptor : taken) close(descriptor);
  if (taken.size() == min_descriptors) return "";
  return fmt::format("only {} files can be opened (ulimit -n; allowed: from {} on)", taken.size(),
                     min_descriptors);
}

int checked_exit_code(int code, const char* program) {
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "%s: standard output: cannot be written (a full disk?)\n", program);
    code = std::max<int>(code, wrong_usage);
  }
  if (std::ferror(stderr) != 0 || !std::cerr) code = std::max<int>(code, wrong_usage);
  return code;
}

void end_for_lack_of_memory_with(const char* message, int exit_code) {
  last_words = message;
  last_code = exit_code;
  std::set_terminate(end_for_lack_of_memory);
}

}  // namespace airybench
