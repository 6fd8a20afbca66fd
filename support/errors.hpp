// How a command ends, and what it throws for that.
#pragma once

#include <stdexcept>

namespace airybench {

enum ExitCode {
  all_ok = 0,
  some_case_failed = 1,
  wrong_usage = 2,    // or a file that cannot be used
  did_not_finish = 3  // out of memory, or a defect of the program itself
};                    // 128 + n: ended by signal n

// What the user gave cannot be used; what() is one line: file or argument, place, value, what is
// allowed. std::invalid_argument is understood in the same way.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Names the argument and what is valid.
struct UsageError : InputError {
  using InputError::InputError;
};
// A file or folder that cannot be read or written, or is not what it should be.
struct FileError : InputError {
  using InputError::InputError;
};
// Asked for help or version: what() is the text. No failure.
struct HelpRequested : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace airybench
