// What a user reads while nothing else is printed.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "support/process.hpp"

namespace airybench {

// Prints what() to standard error if nothing has been heard for $AIRYBENCH_SILENT_S, by default ten
// seconds. For the main process alone, which waits for others.
void sign_of_life(const std::function<std::string()>& what);
void was_heard();  // a line has been printed

// Prints "... WHAT, for 20 s" as often while it lives, for work without a loop: by a child process,
// since a thread would slow down all that is measured later. None if there is no process to be had.
class SignsOfLife {
 public:
  explicit SignsOfLife(const std::string& what);

 private:
  std::optional<ChildProcess> process_;
};
// The text without such lines, of a program whose output is kept until it ends.
std::string without_signs_of_life(const std::string& printed);

}  // namespace airybench
