// hybrid_element.hpp for several elements at a time: in double one per lane of the widest vector
// instructions that the processor has, in other scalars one by one.
//
// One program serves all processors: the kernels are compiled once per instruction set
// (hybrid_kernels_isa.cpp), and the choice is made when the program runs. It changes no bit of an
// answer: lanes are computed as a double by itself would be, without fused operations.
#pragma once

#include <concepts>
#include <utility>
#include <vector>

#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {

template <typename Scalar, int k = 1>
struct HybridKernels {
  const char* name;  // of the instruction set
  int width;         // elements at a time: all arrays have as many entries
  void (*stiffness)(const HybridInput<Scalar, k>* input, bool loaded,
                    HybridStiffness<Scalar, k>* result);
  // displacement: one after another, as many numbers as an element has unknowns.
  void (*stress)(const HybridInput<Scalar, k>* input, bool loaded, const Scalar* displacement,
                 HybridStress<Scalar, k>* result);
};

// Those of every degree, for one instruction set.
template <typename Indices>
struct KernelsOfDegrees;
template <int... i>
struct KernelsOfDegrees<std::integer_sequence<int, i...>> : HybridKernels<double, i + 1>... {};
using StressDegreeIndices = std::make_integer_sequence<int, highest_stress_degree>;
using HybridKernelSet = KernelsOfDegrees<StressDegreeIndices>;

// Those that this processor can run, the widest last; never empty.
const std::vector<HybridKernelSet>& usable_hybrid_kernels();

template <typename Scalar, int k = 1>
HybridKernels<Scalar, k> hybrid_kernels();
template <std::same_as<double> Scalar, int k = 1>
HybridKernels<Scalar, k> hybrid_kernels() {
  return usable_hybrid_kernels().back();
}

}  // namespace airybench
