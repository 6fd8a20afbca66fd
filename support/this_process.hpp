// How a command's process begins, is interrupted, and ends.
#pragma once

#include <stdexcept>

namespace airybench {

// Opens those of the descriptors 0 to 2 that are closed, on /dev/null: else the first files that
// are opened would be taken for them.
void open_standard_streams();

// Ctrl-C, SIGTERM or SIGHUP: what() says which. What has been measured by then is on disk.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int number);
  int signal;
};
// Makes these signals end waiting with Interrupted; a second one ends the program at once.
void catch_interrupts();
bool is_interrupted();
void throw_if_interrupted();

// The exit code of a command: `code`, but wrong_usage where that is less and something could not be
// written to standard output (a full disk; standard error tells it in the program's name) or to
// standard error.
int checked_exit_code(int code, const char* program);

// From now on std::terminate() for a std::bad_alloc, as inside a library that no exception may
// leave, is no crash: it writes the message, a line or nothing, to standard error and ends the
// process with this exit code.
void end_for_lack_of_memory_with(const char* message, int exit_code);

}  // namespace airybench
