// The process's heap, counted at the allocator: heap_probe.cpp replaces malloc, calloc, realloc,
// free and the aligned family, so the libraries' allocations count as well as ours. A block counts
// with its usable size, for the owner that its thread has named (memory_owner.hpp). Memory that is
// mapped without the allocator is not heap: OpenBLAS's packing buffers show in the resident set
// only.
//
// Where the probe cannot be (sanitizers bring their own allocator), heap_probe_off.cpp stands in
// and is_active() is false.
#pragma once

#include <cstdint>
#include <optional>

#include "support/memory_owner.hpp"

namespace airybench::heap {

bool is_active();
std::int64_t live_bytes();
std::int64_t peak_bytes();       // highest live_bytes() since reset_peak()
std::int64_t peak_ever_bytes();  // highest live_bytes() of the process
std::int64_t allocations();      // calls that returned a block, since the start
std::int64_t allocated_bytes();  // asked for by these calls together, whether freed or not
void reset_peak();               // the peaks are then what is live now
bool was_refused();              // has the machine, not a Limit, refused an allocation so far?

// By owner. The live bytes sum to live_bytes().
ByOwner<std::int64_t> live_by_owner();
ByOwner<std::int64_t> peak_by_owner();     // live at peak_bytes(), to a thousandth of it
ByOwner<std::int64_t> highest_by_owner();  // each owner's own highest since reset_peak()

// A second peak for parts of what the first one covers.
std::int64_t lap_peak_bytes();  // highest live_bytes() since reset_lap_peak()
void reset_lap_peak();

// For the scope of the object, allocations that would lift live_bytes() above the limit fail, as on
// a full machine. Blocks below 64 KiB are granted all the same, because OpenBLAS and OpenMP do not
// survive their refusal; exceeded() is then true.
class Limit {
 public:
  explicit Limit(std::int64_t live_bytes_at_most);
  ~Limit();
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
  bool exceeded() const;
};

// For the scope of the object, ends the process with backstop_exit_code when the heap grows beyond
// what a Limit can hold: by small blocks without end, or past the memory that the machine has left;
// or when a library calls exit() because a Limit has refused it a block, as OpenBLAS's threads do.
// limit_bytes: of the Limits to come, or empty; half of it again is granted.
class Backstop {
 public:
  explicit Backstop(std::optional<std::int64_t> limit_bytes);
  ~Backstop();
  Backstop(const Backstop&) = delete;
  Backstop& operator=(const Backstop&) = delete;
};
inline constexpr int backstop_exit_code = 86;

}  // namespace airybench::heap
