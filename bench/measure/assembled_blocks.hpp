// The blocks that methods share, and what assembling them took.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "assembly/dual_system.hpp"

namespace airybench {

struct AssembledBlocks {
  // With the first step's loads, or those of the path's end; null: there is no body.
  std::unique_ptr<DualSystem> system;
  std::vector<double> samples_s;
  std::optional<std::int64_t> heap_bytes;       // live after assembly
  std::optional<std::int64_t> peak_heap_bytes;  // highest during it
};

// problem: null where there is no body, and nothing to assemble.
AssembledBlocks assemble_and_measure(const std::shared_ptr<const Problem>& problem, Blocks which,
                                     int repetitions);

// Nothing where the heap is not watched.
std::optional<std::int64_t> if_probed(std::int64_t bytes);

}  // namespace airybench
