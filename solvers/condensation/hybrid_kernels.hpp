// hybrid_element.hpp for several elements at a time: in double one per lane of the widest vector
// instructions that the processor has, in other scalars one by one.
//
// One program serves all processors: the kernels are compiled once per instruction set
// (hybrid_kernels_isa.cpp), and the choice is made when the program runs. It changes no bit of an
// answer: lanes are computed as a double by itself would be, without fused operations.
#pragma once

#include <vector>

#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {

template <typename Scalar>
struct HybridKernels {
  const char* name;  // of the instruction set
  int width;         // elements at a time: all arrays have as many entries
  void (*stiffness)(const HybridInput<Scalar>* input, bool loaded, HybridStiffness<Scalar>* result);
  // displacement: 12 numbers per element.
  void (*stress)(const HybridInput<Scalar>* input, bool loaded, const Scalar* displacement,
                 HybridStress<Scalar>* result);
};

// Those for double that this processor can run, the widest last; never empty.
const std::vector<HybridKernels<double>>& usable_hybrid_kernels();

template <typename Scalar>
HybridKernels<Scalar> hybrid_kernels();
template <>
HybridKernels<double> hybrid_kernels();

}  // namespace airybench
