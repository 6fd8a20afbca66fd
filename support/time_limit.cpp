#include "support/time_limit.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "support/errors.hpp"
#include "support/messages.hpp"

namespace airybench {
namespace {

std::string complaint_when_over;

// Of calls that a handler of signals may make.
void end_over_time(int) {
  [[maybe_unused]] const ssize_t written =
      write(STDERR_FILENO, complaint_when_over.data(), complaint_when_over.size());
  _exit(wrong_usage);
}

void set_timer(double seconds) {
  constexpr double shortest_s = 1e-3, longest_s = 1e9;  // 0 would be none
  const double within_s = seconds > 0 ? std::clamp(seconds, shortest_s, longest_s) : 0;
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(within_s);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (within_s - static_cast<double>(timer.it_value.tv_sec)));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

TimeLimit::TimeLimit(double seconds, const std::string& complaint) {
  complaint_when_over = shown_message(complaint) + "\n";
  std::signal(SIGALRM, end_over_time);
  set_timer(seconds);
}

TimeLimit::~TimeLimit() {
  set_timer(0);
  std::signal(SIGALRM, SIG_DFL);
}

}  // namespace airybench
