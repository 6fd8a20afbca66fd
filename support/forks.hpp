// What process.cpp and program.cpp share.
#pragma once

#include <sys/types.h>

#include <cerrno>
#include <functional>

#include "support/process.hpp"

namespace airybench {

[[noreturn]] void fail_to(const char* what, int error = errno);

enum class WhenParentEnds { end, go_on };
// Forks and ends with 0 after body. -1: see errno.
pid_t start(WhenParentEnds then, const std::function<void()>& body);

void note_status(int status, ChildEnd& end);

// Called several times a second. A call that is late tells that this process was suspended, by
// SIGSTOP or a freezer; CLOCK_BOOTTIME tells it of a suspended machine, whose other clocks stop.
class Ticks {
 public:
  struct Tick {
    double counted_s, suspended_s;  // since the last tick, together
    bool is_late;
  };
  Ticks() { next(); }
  Tick next();

 private:
  double last_s_ = 0, last_boot_s_ = 0;
};

}  // namespace airybench
