// A limit of time for what takes no deadline.
#pragma once

#include <sys/time.h>

#include <csignal>
#include <string>

namespace airybench {

// If it lives longer, the process ends with the complaint on standard error and wrong_usage;
// infinity: it does not. One at a time; a child process does not inherit it. Another timer of the
// process (SIGALRM) waits meanwhile.
class TimeLimit {
 public:
  TimeLimit(double seconds, const std::string& complaint);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

 private:
  bool is_set_ = false;
  struct sigaction former_action_ = {};
  itimerval former_timer_ = {};
};

}  // namespace airybench
