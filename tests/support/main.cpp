// Tests solve with the kernels of BLAS that bench would take.
#include <gtest/gtest.h>

#include "solvers/base/blas_library.hpp"

int main(int argc, char** argv) {
  airybench::restart_with_better_blas_core(argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
