// Exit codes of commands, and the exceptions that lead to them.
#pragma once

#include <stdexcept>

namespace airybench {

enum ExitCode {
  all_ok = 0,
  some_case_failed = 1,
  wrong_usage = 2,    // or a file that cannot be used
  did_not_finish = 3  // out of memory, or a defect of the program itself
};                    // 128 + n: ended by signal n

// Unusable input; what() is one line: file or argument, place, value, what is allowed.
// std::invalid_argument is treated alike.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct UsageError : InputError {
  using InputError::InputError;
};
// A file or folder that cannot be read or written, or has the wrong content.
struct FileError : InputError {
  using InputError::InputError;
};
// The user asked for help or version; what() is the text. Not a failure.
struct HelpRequested : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace airybench
