// Instructions that this process executes, from the processor's own counter: a figure that other
// work on the machine does not disturb.
//
// Linux's perf_event_open(2), user space only. Threads count that are started while the counter
// lives, by the thread that made it or its descendants; a pool that was there before does not.
#pragma once

#include <cstdint>
#include <optional>

namespace airybench {

class InstructionCounter {
 public:
  InstructionCounter();  // begins to count
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  // Since construction. Empty where the machine has no such counter (many virtual ones), the kernel
  // does not allow it (/proc/sys/kernel/perf_event_paranoid, containers), or others had it for part
  // of the time.
  std::optional<std::int64_t> count() const;

 private:
  int file_;  // -1: not available
};

}  // namespace airybench
