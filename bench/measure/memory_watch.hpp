// Watches the heap of one solve, from its construction on.
#pragma once

#include <optional>

#include "bench/measure/memory_split.hpp"
#include "solvers/base/stage_times.hpp"

namespace airybench {

class MemoryWatch : public StageObserver {
 public:
  // held_by_blocks: what the solve's blocks hold already, which counts as the solve's. Resets the
  // heap's peaks.
  explicit MemoryWatch(std::int64_t held_by_blocks);

  void begins(Stage stage) override;
  void ends(Stage stage) override;

  std::int64_t peak_bytes() const;
  // What has been seen, beside what the method and its blocks count.
  MemorySplit split(const Solution& solution, std::size_t counted_blocks) const;

 private:
  std::int64_t of_solve(std::int64_t live_bytes) const;  // without what is of others
  ByOwner<std::int64_t> of_solve(ByOwner<std::int64_t> live_bytes) const;

  std::int64_t held_by_blocks_, allocations_, allocated_bytes_, before_;
  ByOwner<std::int64_t> before_by_owner_;
  ByOwner<std::int64_t> held_;
  std::array<std::optional<std::int64_t>, all_stages.size()> stage_peak_;
  ObservedStages observed_{this};
};

}  // namespace airybench
