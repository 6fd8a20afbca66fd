// Standard output led to nowhere while it lives, for libraries that print there.
#pragma once

namespace airybench {

class QuietStdout {
 public:
  QuietStdout();
  ~QuietStdout();
  QuietStdout(const QuietStdout&) = delete;
  QuietStdout& operator=(const QuietStdout&) = delete;

 private:
  int saved_;  // file descriptor of the real one
};

}  // namespace airybench
