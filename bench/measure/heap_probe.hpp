// Counts the process's heap: heap_probe.cpp replaces malloc and its family, for libraries too. A
// block counts with its usable size, for the owner that its thread has named (memory_owner.hpp).
// Memory mapped without the allocator, such as OpenBLAS's packing buffers, is not heap. Sanitizers
// bring their own allocator: heap_probe_off.cpp then stands in, and is_active() is false.
#pragma once

#include <cstdint>
#include <optional>

#include "support/memory_owner.hpp"

namespace airybench::heap {

bool is_active();
std::int64_t live_bytes();
std::int64_t peak_bytes();       // highest live_bytes() since reset_peak()
std::int64_t peak_ever_bytes();  // highest live_bytes() of the process
std::int64_t allocations();      // calls that returned a block
std::int64_t allocated_bytes();  // requested by these calls, freed or not
void reset_peak();               // sets the peaks to live_bytes()
bool was_refused();              // the machine, not a Limit, has refused an allocation

// By owner; the live bytes sum to live_bytes().
ByOwner<std::int64_t> live_by_owner();
ByOwner<std::int64_t> peak_by_owner();     // at peak_bytes(), to 0.1 % of it
ByOwner<std::int64_t> highest_by_owner();  // each owner's own highest since reset_peak()

// While the object lives, allocations that would lift live_bytes() above the limit fail and set
// exceeded(); blocks below 64 KiB do not fail, as OpenBLAS and OpenMP do not survive that.
class Limit {
 public:
  explicit Limit(std::int64_t live_bytes_at_most);
  ~Limit();
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
  bool exceeded() const;
};

// Ends the process with backstop_exit_code if the heap outgrows what a Limit can hold (small
// blocks, or all that the machine has), or if a library calls exit() after a refusal, as OpenBLAS's
// threads do. limit_bytes: of the Limits to come; 1.5 times as much is granted.
class Backstop {
 public:
  explicit Backstop(std::optional<std::int64_t> limit_bytes);
  ~Backstop();
  Backstop(const Backstop&) = delete;
  Backstop& operator=(const Backstop&) = delete;
};
inline constexpr int backstop_exit_code = 86;

}  // namespace airybench::heap
