#include "bench/measure/solve_watch.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "bench/measure/heap_probe.hpp"

namespace airybench {
namespace {

std::int64_t bytes_of_answer(const Solution& solution) {
  auto doubles = solution.F_C.size() + solution.stress.values().size();
  if (const auto* const airy = solution.as<AiryFunction>()) doubles += airy->phi.size();
  if (const auto* const edges = solution.as<EdgeDisplacements>()) doubles += edges->moments.size();
  if (const auto* const own = solution.as<Displacements>()) doubles += own->w.size();
  return static_cast<std::int64_t>(static_cast<std::size_t>(doubles) * sizeof(double));
}

}  // namespace

bool counts_differ(const MemorySplit& memory) {
  constexpr std::int64_t slack_bytes = 64 * 1024;
  return std::ranges::any_of(all_memory_owners, [&](MemoryOwner owner) {
    const std::int64_t counted = memory.counted[owner];
    return counted > 0 &&
           std::abs(memory.held[owner] - counted) > std::max(counted / 10, slack_bytes);
  });
}

Json by_owner(const MemorySplit& memory) {
  Json json = Json::object();
  for (const MemoryOwner owner : all_memory_owners) {
    const std::int64_t peak = memory.at_peak[owner], held = memory.held[owner],
                       counted = memory.counted[owner];
    if (peak == 0 && held == 0 && counted == 0) continue;
    json[std::string(name_of(owner))] = {{"peak_bytes", peak},
                                         {"held_bytes", held},
                                         {"counted_bytes", counted > 0 ? Json(counted) : nullptr}};
  }
  return json;
}

MemoryWatch::MemoryWatch(std::int64_t held_by_blocks) : held_by_blocks_(held_by_blocks) {
  seen_.heap_allocations = heap::allocations();
  seen_.heap_allocated_bytes = heap::allocated_bytes();
  heap::reset_peak();
  before_ = heap::live_bytes();
  before_by_owner_ = heap::live_by_owner();
}

void MemoryWatch::ends(Stage) {
  const ByOwner<std::int64_t> live = of_solve(heap::live_by_owner());
  for (const MemoryOwner owner : all_memory_owners)
    seen_.held[owner] = std::max(seen_.held[owner], live[owner]);
}

std::int64_t MemoryWatch::peak_bytes() const { return of_solve(heap::peak_bytes()); }

MemorySplit MemoryWatch::split(const Solution& solution, std::size_t counted_blocks) const {
  MemorySplit memory = seen_;
  memory.at_peak = of_solve(heap::peak_by_owner());
  memory.held[MemoryOwner::iteration] = of_solve(heap::highest_by_owner())[MemoryOwner::iteration];
  std::ranges::copy(solution.storage.values, memory.counted.values.begin());
  memory.counted[MemoryOwner::blocks] = static_cast<std::int64_t>(counted_blocks);
  memory.counted[MemoryOwner::answer] = bytes_of_answer(solution);
  memory.heap_allocations = heap::allocations() - seen_.heap_allocations;
  memory.heap_allocated_bytes = heap::allocated_bytes() - seen_.heap_allocated_bytes;
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

namespace rss {

bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;  // proc(5): reset the peak resident set size
  return file.good();
}

std::optional<std::int64_t> peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    if (word != "VmHWM:") continue;
    std::int64_t kibibytes = 0;
    if (file >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

}  // namespace rss

}  // namespace airybench
