#include "solvers/direct/factor_counts.hpp"

namespace airybench {
namespace {

template <typename LibraryFactor>
void count(const LibraryFactor& factor, Solution& solution) {
  solution.storage[MemoryOwner::factor] = factor.bytes();
  solution.library_bytes = static_cast<std::int64_t>(factor.library_bytes());
  solution.factor_entries = factor.entries();
  solution.factor_flops = factor.flops();
}

}  // namespace

void count_factor(const SkylineFactor& factor, Solution& solution) {
  solution.storage[MemoryOwner::factor] = factor.bytes();
  solution.factor_entries = factor.profile.profile;
  solution.factor_flops = factor.profile.factor_flops;
}

void count_factor(const CholmodFactor& factor, Solution& solution) { count(factor, solution); }
void count_factor(const MumpsFactor& factor, Solution& solution) { count(factor, solution); }

}  // namespace airybench
