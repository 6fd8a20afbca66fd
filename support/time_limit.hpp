// A limit of time for what takes no deadline.
#pragma once

#include <string>

namespace airybench {

// If it lives longer, the process ends with the complaint on standard error and wrong_usage. One at
// a time; a child process does not inherit it.
class TimeLimit {
 public:
  TimeLimit(double seconds, const std::string& complaint);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
};

}  // namespace airybench
