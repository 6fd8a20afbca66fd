// Attributes heap blocks to owners: a block belongs to the owner that its thread has named.
//
//   const OwnerScope scope(MemoryOwner::factor);   // until the end of the block; scopes nest
//
// A block keeps its owner until it is freed, also by another thread and when it grows. Naming costs
// two writes to a thread-local variable. bench/measure/heap_probe.hpp counts, if it is linked.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace airybench {

enum class MemoryOwner : std::uint8_t {
  other,           // not named
  blocks,          // S, C_F, C_C, q … as assembled
  system_matrix,   // what a method assembles itself: K of HYBRID and P2, M₁₁ of BLIND
  factor,          // of a direct method, with what its analysis and its solves keep
  preconditioner,  // S*, and SYMMLQ's Schur block
  intermediate,    // of the three steps: S⁻¹ Cᵀ, K_FF, K_FF⁻¹ K_FC
  condensed,       // D, G, and the contact law on them
  iteration,       // vectors of a Krylov or Uzawa iteration
  answer,          // φ, stresses, displacements
  check,           // the method's own estimate of its error, refinement
};
inline constexpr std::array<MemoryOwner, 10> all_memory_owners = {
    MemoryOwner::other,     MemoryOwner::blocks,         MemoryOwner::system_matrix,
    MemoryOwner::factor,    MemoryOwner::preconditioner, MemoryOwner::intermediate,
    MemoryOwner::condensed, MemoryOwner::iteration,      MemoryOwner::answer,
    MemoryOwner::check};

constexpr std::string_view name_of(MemoryOwner owner) {
  constexpr std::array<std::string_view, all_memory_owners.size()> names = {
      "other",        "blocks",    "system_matrix", "factor", "preconditioner",
      "intermediate", "condensed", "iteration",     "answer", "check"};
  return names[static_cast<std::size_t>(owner)];
}

template <typename T>
struct ByOwner {
  std::array<T, all_memory_owners.size()> values{};
  T& operator[](MemoryOwner owner) { return values[static_cast<std::size_t>(owner)]; }
  const T& operator[](MemoryOwner owner) const { return values[static_cast<std::size_t>(owner)]; }
  T sum() const { return std::accumulate(values.begin(), values.end(), T{}); }
};

// `other` in a new thread.
inline constinit thread_local MemoryOwner current_memory_owner = MemoryOwner::other;

class OwnerScope {
 public:
  explicit OwnerScope(MemoryOwner owner) : before_(current_memory_owner) {
    current_memory_owner = owner;
  }
  ~OwnerScope() { current_memory_owner = before_; }
  OwnerScope(const OwnerScope&) = delete;
  OwnerScope& operator=(const OwnerScope&) = delete;

 private:
  MemoryOwner before_;
};

}  // namespace airybench
