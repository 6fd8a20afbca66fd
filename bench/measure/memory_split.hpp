// Where the heap of a solve went: by owner (memory_owner.hpp) and by stage, beside what the method
// counts for itself. All in bytes above what was live before the solve, the blocks counted in.
//
// Measured and counted are compared at one moment: an owner's bytes at the ends of stages, the most
// of them. By then what building took is gone and what the method keeps is there, which is what it
// counts; at the overall peak one owner may be half built, copied or gone. The vectors of an
// iteration live inside a stage, so theirs is the owner's own highest.
#pragma once

#include <optional>

#include "bench/records/json.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

struct MemorySplit {
  ByOwner<std::int64_t> at_peak;  // at the solve's overall peak, to a thousandth of the live heap
  ByOwner<std::int64_t> held;     // as above
  ByOwner<std::int64_t> counted;  // entries × size; zero: not counted
  std::array<std::optional<std::int64_t>, all_stages.size()> stage_peak;  // empty: not run
  std::int64_t allocations = 0, allocated_bytes = 0;                      // whether freed or not
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
}  // namespace airybench
