#include "solvers/condensation/hybrid_kernels.hpp"

namespace airybench {

extern const HybridKernels<double> hybrid_kernels_baseline;
#ifdef AIRYBENCH_X86_KERNELS
extern const HybridKernels<double> hybrid_kernels_avx2, hybrid_kernels_avx512f;
#endif

const std::vector<HybridKernels<double>>& usable_hybrid_kernels() {
  static const std::vector<HybridKernels<double>> usable = [] {
    std::vector<HybridKernels<double>> kernels = {hybrid_kernels_baseline};
#ifdef AIRYBENCH_X86_KERNELS
    if (__builtin_cpu_supports("avx2")) kernels.push_back(hybrid_kernels_avx2);
    if (__builtin_cpu_supports("avx512f")) kernels.push_back(hybrid_kernels_avx512f);
#endif
    return kernels;
  }();
  return usable;
}

template <>
HybridKernels<double> hybrid_kernels() {
  return usable_hybrid_kernels().back();
}

}  // namespace airybench
