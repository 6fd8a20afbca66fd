// How a command's process begins, is interrupted, and ends.
#pragma once

#include <csignal>
#include <stdexcept>
#include <string>

namespace airybench {

// Opens /dev/null on closed descriptors 0 to 2, or the first files opened would take their place.
// A file that may not grow (ulimit -f) becomes a write error from here on, not the end by SIGXFSZ.
void open_standard_streams();
// For commands whose result goes there. Throws UsageError if standard output was closed at the
// start.
void require_standard_output();

// Why stack (ulimit -s) or free descriptors (ulimit -n) are too few for any command; "" if not.
std::string lack_of_stack_or_descriptors();

// Ctrl-C, SIGTERM or, but for nohup, SIGHUP; what() names it. The results so far are on disk.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int number);
  int signal;
};
// After one of these signals throw_if_interrupted() throws; a second one, but for SIGHUP, ends the
// program at once.
void catch_interrupts();
// SIGHUP comes, too, when the process that started this program ends.
void interrupt_with_caller();
// The same for Ctrl-C alone, while it lives: then what was before holds, and nothing is
// interrupted.
class CtrlCInterrupts {
 public:
  CtrlCInterrupts();
  ~CtrlCInterrupts();
  CtrlCInterrupts(const CtrlCInterrupts&) = delete;
  CtrlCInterrupts& operator=(const CtrlCInterrupts&) = delete;

 private:
  struct sigaction former_ = {};
};
bool is_interrupted();
void throw_if_interrupted();

// `code`, but at least wrong_usage if standard output or standard error could not be written.
int checked_exit_code(int code, const char* program);

// A std::bad_alloc that leads to std::terminate() (a library may let no exception out) then writes
// the message to standard error and ends the process with this exit code.
void end_for_lack_of_memory_with(const char* message, int exit_code);

}  // namespace airybench
