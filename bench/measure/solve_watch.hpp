// Heap of one solve by owner (memory_owner.hpp), and its resident set.
//
// Heap bytes exclude what was live before the solve, but include the blocks. An owner's measured
// bytes are its largest at the ends of stages, when workspace is gone and what the method keeps is
// there; vectors of an iteration live inside a stage, so theirs is the owner's own peak.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/records/json.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

struct MemorySplit {
  ByOwner<std::int64_t> at_peak;  // at the solve's peak, to 0.1 % of the live heap
  ByOwner<std::int64_t> held;     // as described above
  ByOwner<std::int64_t> counted;  // entries × size; zero: not counted
  std::int64_t heap_allocations = 0, heap_allocated_bytes = 0;  // freed or not
};

// Whether some owner's held bytes differ from its count by more than 10 % and more than 64 KiB.
bool counts_differ(const MemorySplit& memory);

// {"factor": {"peak_bytes": …, "held_bytes": …, "counted_bytes": … or null}, …}; no empty owners.
Json by_owner(const MemorySplit& memory);

class MemoryWatch : public StageObserver {
 public:
  // held_by_blocks: bytes of the solve's blocks, which count as its own. Resets the heap's peaks.
  explicit MemoryWatch(std::int64_t held_by_blocks);

  void begins(Stage) override {}
  void ends(Stage stage) override;

  std::int64_t peak_bytes() const;
  MemorySplit split(const Solution& solution, std::size_t counted_blocks) const;

 private:
  std::int64_t of_solve(std::int64_t live_bytes) const;
  ByOwner<std::int64_t> of_solve(ByOwner<std::int64_t> live_bytes) const;

  std::int64_t held_by_blocks_, before_;
  ByOwner<std::int64_t> before_by_owner_;
  MemorySplit seen_;  // so far; for allocations the counts before
  ObservedStages observed_{this};
};

namespace rss {
// Sets the kernel's high-water mark to the present resident set; false if not allowed.
bool reset_peak();
std::optional<std::int64_t> peak_bytes();  // the high-water mark, VmHWM
}  // namespace rss

}  // namespace airybench
