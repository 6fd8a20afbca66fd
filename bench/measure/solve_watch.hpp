// What one solve takes besides time: heap by owner (memory_owner.hpp) and by stage, next to what
// the method counts for itself; resident set; instructions.
//
// All bytes of heap are above what was live before the solve, the blocks counted in. Measured and
// counted are compared at the ends of stages, the most of an owner's bytes there: by then the
// workspace of building is gone and what the method keeps, and counts, is there. The vectors of an
// iteration live inside a stage, so theirs is the owner's own highest.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/records/json.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

struct MemorySplit {
  ByOwner<std::int64_t> at_peak;  // at the solve's overall peak, to a thousandth of the live heap
  ByOwner<std::int64_t> held;     // as above
  ByOwner<std::int64_t> counted;  // entries × size; zero: not counted
  std::array<std::optional<std::int64_t>, all_stages.size()> stage_peak;  // empty: not run
  std::int64_t heap_allocations = 0, heap_allocated_bytes = 0;            // whether freed or not
};

// Σ held / Σ counted over the owners that are counted, without the blocks, which the method did not
// make. Empty: there are none.
std::optional<double> count_ratio(const MemorySplit& memory);

// Is any owner's held more than 10 % of its count, and more than 64 KiB, away from it?
bool counts_differ(const MemorySplit& memory);

// {"factor": {"peak_bytes": …, "held_bytes": …, "counted_bytes": … or null}, …}; only owners that
// have something.
Json by_owner(const MemorySplit& memory);
// {"order": highest heap while it ran, …}; only stages that ran.
Json by_stage(const MemorySplit& memory);

// Watches the heap of one solve, from its construction on.
class MemoryWatch : public StageObserver {
 public:
  // held_by_blocks: what the solve's blocks hold already, which counts as the solve's. Resets the
  // heap's peaks.
  explicit MemoryWatch(std::int64_t held_by_blocks);

  void begins(Stage stage) override;
  void ends(Stage stage) override;

  std::int64_t peak_bytes() const;
  // counted_blocks: bytes that the blocks count.
  MemorySplit split(const Solution& solution, std::size_t counted_blocks) const;

 private:
  std::int64_t of_solve(std::int64_t live_bytes) const;
  ByOwner<std::int64_t> of_solve(ByOwner<std::int64_t> live_bytes) const;

  std::int64_t held_by_blocks_, before_;
  ByOwner<std::int64_t> before_by_owner_;
  MemorySplit seen_;  // until now; of allocations those before
  ObservedStages observed_{this};
};

// The process's resident set: code, heap, mapped buffers.
namespace rss {
// Sets the kernel's high-water mark to the present resident set; false where that is not allowed.
bool reset_peak();
std::optional<std::int64_t> peak_bytes();  // the high-water mark, VmHWM
}  // namespace rss

// Instructions that this process executes in user space, by Linux's perf_event_open(2): other work
// on the machine does not disturb the figure. Of threads those count that are started while the
// counter lives, by the thread that made it or its descendants.
class InstructionCounter {
 public:
  InstructionCounter();  // begins to count
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  // Since construction. Empty where the machine has no such counter (many virtual ones), the kernel
  // forbids it (/proc/sys/kernel/perf_event_paranoid), or others had it for part of the time.
  std::optional<std::int64_t> count() const;

 private:
  int file_;  // -1: not available
};

}  // namespace airybench
