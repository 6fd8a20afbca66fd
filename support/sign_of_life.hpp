// What a user reads while nothing else is printed.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace airybench {

// Prints what() to standard error if nothing has been heard for $AIRYBENCH_SILENT_S, by default ten
// seconds. For the main process alone, which waits for others.
void sign_of_life(const std::function<std::string()>& what);
void was_heard();  // a line has been printed

// The same while it lives, by a thread, for work without a loop: "... WHAT, for 20 s".
class SignsOfLife {
 public:
  explicit SignsOfLife(std::string what);
  ~SignsOfLife();
  SignsOfLife(const SignsOfLife&) = delete;
  SignsOfLife& operator=(const SignsOfLife&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread thread_;
};
// The text without such lines, of a program whose output is kept until it ends.
std::string without_signs_of_life(const std::string& printed);

}  // namespace airybench
