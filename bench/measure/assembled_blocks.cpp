#include "bench/measure/assembled_blocks.hpp"

#include <chrono>

#include "bench/measure/heap_probe.hpp"
#include "support/memory_owner.hpp"
#include "support/seconds_since.hpp"

namespace airybench {

AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions) {
  AssembledBlocks blocks;
  for (int i = 0; i < repetitions; ++i) {
    blocks.system.reset();
    heap::reset_peak();
    const std::int64_t before = heap::live_bytes();
    const auto start = std::chrono::steady_clock::now();
    const OwnerScope scope(MemoryOwner::blocks);
    if (problem) blocks.system.reset(new DualSystem(assemble(problem, which)));  // no copy
    blocks.samples_s.push_back(seconds_since(start));
    blocks.heap_bytes = if_probed(heap::live_bytes() - before);
    blocks.peak_heap_bytes = if_probed(heap::peak_bytes() - before);
  }
  return blocks;
}

std::optional<std::int64_t> if_probed(std::int64_t bytes) {
  return heap::is_active() ? std::optional(bytes) : std::nullopt;
}

}  // namespace airybench
