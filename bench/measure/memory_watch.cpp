#include "bench/measure/memory_watch.hpp"

#include <algorithm>

#include "bench/measure/heap_probe.hpp"

namespace airybench {
namespace {

std::int64_t bytes_of_answer(const Solution& solution) {
  const auto doubles = solution.F_C.size() + solution.phi.size() + solution.displacement.size() +
                       solution.edge_moments.size();
  return static_cast<std::int64_t>(static_cast<std::size_t>(doubles) * sizeof(double) +
                                   solution.stress.size() * sizeof(ElementStress));
}

}  // namespace

MemoryWatch::MemoryWatch(std::int64_t held_by_blocks)
    : held_by_blocks_(held_by_blocks),
      allocations_(heap::allocations()),
      allocated_bytes_(heap::allocated_bytes()) {
  heap::reset_peak();
  before_ = heap::live_bytes();
  before_by_owner_ = heap::live_by_owner();
}

void MemoryWatch::begins(Stage) { heap::reset_lap_peak(); }

void MemoryWatch::ends(Stage stage) {
  std::optional<std::int64_t>& peak = stage_peak_[static_cast<std::size_t>(stage)];
  peak = std::max(peak.value_or(0), of_solve(heap::lap_peak_bytes()));
  const ByOwner<std::int64_t> live = of_solve(heap::live_by_owner());
  for (const MemoryOwner owner : all_memory_owners)
    held_[owner] = std::max(held_[owner], live[owner]);
}

std::int64_t MemoryWatch::peak_bytes() const { return of_solve(heap::peak_bytes()); }

MemorySplit MemoryWatch::split(const Solution& solution, std::size_t counted_blocks) const {
  MemorySplit memory;
  memory.at_peak = of_solve(heap::peak_by_owner());
  memory.held = held_;
  memory.held[MemoryOwner::iteration] = of_solve(heap::highest_by_owner())[MemoryOwner::iteration];
  std::transform(solution.storage.values.begin(), solution.storage.values.end(),
                 memory.counted.values.begin(),
                 [](std::size_t bytes) { return static_cast<std::int64_t>(bytes); });
  memory.counted[MemoryOwner::blocks] = static_cast<std::int64_t>(counted_blocks);
  memory.counted[MemoryOwner::answer] = bytes_of_answer(solution);
  memory.stage_peak = stage_peak_;
  memory.allocations = heap::allocations() - allocations_;
  memory.allocated_bytes = heap::allocated_bytes() - allocated_bytes_;
  return memory;
}

std::int64_t MemoryWatch::of_solve(std::int64_t live_bytes) const {
  return live_bytes - before_ + held_by_blocks_;
}

ByOwner<std::int64_t> MemoryWatch::of_solve(ByOwner<std::int64_t> live_bytes) const {
  for (const MemoryOwner owner : all_memory_owners) live_bytes[owner] -= before_by_owner_[owner];
  live_bytes[MemoryOwner::blocks] += held_by_blocks_;
  return live_bytes;
}

}  // namespace airybench
