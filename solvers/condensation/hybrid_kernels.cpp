#include "solvers/condensation/hybrid_kernels.hpp"

namespace airybench {

extern const HybridKernelSet hybrid_kernels_baseline;
#ifdef AIRYBENCH_X86_KERNELS
extern const HybridKernelSet hybrid_kernels_avx2, hybrid_kernels_avx512f;
#endif

const std::vector<HybridKernelSet>& usable_hybrid_kernels() {
  static const std::vector<HybridKernelSet> usable = [] {
    std::vector<HybridKernelSet> kernels = {hybrid_kernels_baseline};
#ifdef AIRYBENCH_X86_KERNELS
    if (__builtin_cpu_supports("avx2")) kernels.push_back(hybrid_kernels_avx2);
    if (__builtin_cpu_supports("avx512f")) kernels.push_back(hybrid_kernels_avx512f);
#endif
    return kernels;
  }();
  return usable;
}

}  // namespace airybench
