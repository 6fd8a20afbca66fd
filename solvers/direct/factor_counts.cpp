#include "solvers/direct/factor_counts.hpp"

namespace airybench {
namespace {

template <typename Factor>
void count(const Factor& factor, Solution& solution) {
  solution.storage[MemoryOwner::factor] = factor.bytes();
  solution.factor_entries = factor.entries();
  solution.factor_flops = factor.flops();
}

template <typename LibraryFactor>
void count_library(const LibraryFactor& factor, Solution& solution) {
  count(factor, solution);
  solution.library_bytes = static_cast<std::int64_t>(factor.library_bytes());
}

}  // namespace

void count_factor(const SkylineFactor& factor, Solution& solution) {
  solution.storage[MemoryOwner::factor] = factor.bytes();
  solution.factor_entries = factor.profile.profile;
  solution.factor_flops = factor.profile.factor_flops;
}

SkylineFactor factor_in_stages(const Eigen::SparseMatrix<double>& lower, const Deadline& deadline,
                               Solution& solution) {
  SkylineProfile profile = run_stage(solution.times, Stage::order, MemoryOwner::factor,
                                     [&] { return analyse_skyline(lower); });
  SkylineFactor factor = run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] {
    return factor_ldlt(std::move(profile), lower, deadline);
  });
  count_factor(factor, solution);
  return factor;
}

void count_factor(const MultifrontalFactor& factor, Solution& solution) { count(factor, solution); }
void count_factor(const CholmodFactor& factor, Solution& solution) {
  count_library(factor, solution);
}
void count_factor(const MumpsFactor& factor, Solution& solution) {
  count_library(factor, solution);
}

}  // namespace airybench
