#include "bench/measure/memory_split.hpp"

#include <algorithm>
#include <cstdlib>

#include "bench/records/json.hpp"

namespace airybench {

std::optional<double> count_ratio(const MemorySplit& memory) {
  std::int64_t held = 0, counted = 0;
  for (const MemoryOwner owner : all_memory_owners) {
    if (owner == MemoryOwner::blocks || memory.counted[owner] == 0) continue;
    held += memory.held[owner];
    counted += memory.counted[owner];
  }
  if (counted == 0) return {};
  return static_cast<double>(held) / static_cast<double>(counted);
}

bool counts_differ(const MemorySplit& memory) {
  constexpr std::int64_t slack_bytes = 64 * 1024;
  return std::any_of(all_memory_owners.begin(), all_memory_owners.end(), [&](MemoryOwner owner) {
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

Json by_stage(const MemorySplit& memory) {
  Json json = Json::object();
  for (const Stage stage : all_stages)
    if (const auto& bytes = memory.stage_peak[static_cast<std::size_t>(stage)])
      json[std::string(name_of(stage))] = *bytes;
  return json;
}

}  // namespace airybench
