// What one solve needs of memory: its heap by owner (memory_owner.hpp) and by stage, next to what
// the method counts for itself, and the process's resident set.
//
// All bytes of heap are above what was live before the solve, the blocks counted in. Measured and
// counted are compared at one moment: an owner's bytes at the ends of stages, the most of them. By
// then the workspace of building is gone and what the method keeps, which is what it counts, is
// there; at the overall peak one owner may be half built, copied or gone. The vectors of an
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

// The process's resident set, from Linux's /proc. Includes everything: code, heap, mapped buffers.
namespace rss {
// Sets the kernel's high-water mark to the present resident set; false where that is not allowed.
bool reset_peak();
// The high-water mark (VmHWM), bytes.
std::optional<std::int64_t> peak_bytes();
}  // namespace rss

}  // namespace airybench
