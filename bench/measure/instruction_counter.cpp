#include "bench/measure/instruction_counter.hpp"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace airybench {
namespace {

int open_counter() {
  perf_event_attr attributes = {};
  attributes.size = sizeof attributes;
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  attributes.inherit = 1;
  attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  constexpr int this_thread = 0, any_cpu = -1, no_group = -1;
  return static_cast<int>(syscall(SYS_perf_event_open, &attributes, this_thread, any_cpu, no_group,
                                  PERF_FLAG_FD_CLOEXEC));
}

}  // namespace

InstructionCounter::InstructionCounter() : file_(open_counter()) {}

InstructionCounter::~InstructionCounter() {
  if (file_ >= 0) close(file_);
}

std::optional<std::int64_t> InstructionCounter::count() const {
  struct {
    std::uint64_t instructions, time_enabled, time_running;
  } counted = {};
  if (file_ < 0 || read(file_, &counted, sizeof counted) != sizeof counted) return {};
  // A counter that was shared out, or never ran, has only part of them.
  if (counted.time_running == 0 || counted.time_running != counted.time_enabled) return {};
  return static_cast<std::int64_t>(counted.instructions);
}

}  // namespace airybench
