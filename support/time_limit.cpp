#include "support/time_limit.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

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

itimerval timer_within(double seconds) {
  constexpr double shortest_s = 1e-3, longest_s = 1e9;  // 0 would be none
  const double within_s = std::clamp(seconds, shortest_s, longest_s);
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(within_s);
  timer.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (within_s - static_cast<double>(timer.it_value.tv_sec)));
  return timer;
}

}  // namespace

TimeLimit::TimeLimit(double seconds, const std::string& complaint)
    : is_set_(std::isfinite(seconds)) {
  if (!is_set_) return;
  complaint_when_over = shown_message(complaint) + "\n";
  struct sigaction action = {};
  action.sa_handler = end_over_time;
  sigaction(SIGALRM, &action, &former_action_);
  const itimerval timer = timer_within(seconds);
  setitimer(ITIMER_REAL, &timer, &former_timer_);
}

TimeLimit::~TimeLimit() {
  if (!is_set_) return;
  constexpr itimerval none = {};
  setitimer(ITIMER_REAL, &none, nullptr);
  sigaction(SIGALRM, &former_action_, nullptr);
  setitimer(ITIMER_REAL, &former_timer_, nullptr);
}

}  // namespace airybench
